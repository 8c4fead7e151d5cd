// Accuracy case A12: every mode of a free steel bar dies away by the T60 = 6.908 / d that its
// damping law says, d = (alpha + beta w^2 + eta w) / 2 or as tabulated, at rest and while the bar
// spins.
#include "mesh/generate.h"
#include "modal/modal_decay.h"
#include "modal/solve_modes.h"
#include "model/damping.h"
#include "world/soft_world.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <ode/ode.h>

#include <functional>
#include <numbers>

namespace ode::soft {
namespace {

constexpr std::size_t kModes = 3;

/// Motion of a body against its rest shape, seen from the frame that turns with it.
struct Deformation {
    std::vector<Vec3> displacement, velocity;

    explicit Deformation(const Body& body) {
        const NodeState& s = body.state();
        const std::size_t n = body.mass().size();
        Vec3 rest = Vec3::Zero(), centre = rest, speed = rest, angular = rest;
        double mass = 0;
        for (std::size_t i = 0; i < n; ++i) {
            rest += body.mass()[i] * body.mesh().node[i];
            centre += body.mass()[i] * s.position[i];
            speed += body.mass()[i] * s.velocity[i];
            mass += body.mass()[i];
        }
        rest /= mass, centre /= mass, speed /= mass;
        Mat3 moment = Mat3::Zero(), inertia = Mat3::Zero();
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 r = s.position[i] - centre;
            moment += body.mass()[i] * r * (body.mesh().node[i] - rest).transpose();
            inertia += body.mass()[i] * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
            angular += body.mass()[i] * r.cross(s.velocity[i]);
        }
        const Vec3 spin = inertia.inverse() * angular;
        const Eigen::JacobiSVD<Mat3> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
        const Mat3 turn = svd.matrixU() * svd.matrixV().transpose();
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 r = s.position[i] - centre;
            displacement.push_back(turn.transpose() * r - (body.mesh().node[i] - rest));
            velocity.push_back(turn.transpose() * (s.velocity[i] - speed - spin.cross(r)));
        }
    }
};

/// Amplitudes of velocity of the lowest modes.
std::array<double, kModes> amplitudes(const Body& body, const ModalModel& modes) {
    const Deformation now(body);
    std::array<double, kModes> out;
    for (std::size_t k = 0; k < kModes; ++k) {
        double q = 0, rate = 0;
        for (std::size_t i = 0; i < body.mass().size(); ++i) {
            const Vec3 share = body.mass()[i] * modes.shape_at(k, i);
            q += share.dot(now.displacement[i]);
            rate += share.dot(now.velocity[i]);
        }
        out[k] = std::hypot(2 * std::numbers::pi * modes.frequency[k] * q, rate);
    }
    return out;
}

/// Least squares of ln a over time.
struct DecayFit {
    double st = 0, sy = 0, stt = 0, sty = 0;
    int n = 0;

    void add(double t, double a) {
        const double y = std::log(a);
        st += t, sy += y, stt += t * t, sty += t * y, ++n;
    }
    double decay() const { return -(n * sty - st * sy) / (n * stt - st * st); }
};

Solid steel() {
    Solid s;
    s.young = 200e9;
    s.poisson = 0.29;
    s.density = 7850;
    return s;
}

struct Ringing {
    TetMesh mesh = make_bar(0.1, 0.02, 0.01, 5, 1, 1);
    std::vector<Solid> solids{steel()};
    BodyForm form;
    Vec3 spin = Vec3::Zero(); ///< [rad/s]
};

using Expected = std::function<std::vector<double>(const TetMesh&, const ModalModel&)>;

/// Strikes the lowest modes at once, leaves the body alone and compares each one's T60.
/// @param expected  decay rates of the modes [1/s]
void rings_down_as_predicted(const Ringing& r, const Expected& expected) {
    dInitODE2(0);
    dWorldID world = dWorldCreate();
    dSpaceID space = dSimpleSpaceCreate(nullptr);
    {
        SoftWorld soft(world, space);
        Body& body = soft.create_body(r.mesh, r.solids);
        body.set_form(r.form);
        ModalOptions options;
        options.order = body.mesh().order;
        options.mass = MassKind::kLumped;
        options.estimate = false;
        options.max_frequency = 1e6;
        options.max_modes = kModes;
        const ModalModel modes = solve_modes(body.mesh(), body.solids(), options);
        const std::vector<double> decays = expected(body.mesh(), modes);
        body.add_spin(r.spin);
        // The bar bends 1e-8 m, far inside the linear range.
        for (std::size_t i = 0; i < body.mass().size(); ++i)
            for (std::size_t k = 0; k < kModes; ++k)
                body.add_force(static_cast<int>(i), 0.1 * body.mass()[i] * modes.shape_at(k, i));
        const double step = 0.1 / modes.frequency[kModes - 1];
        soft.step(step, dWorldStep);
        const Vec3 linear = body.linear_momentum(), angular = body.angular_momentum();
        // Over the first 20 dB; a ripples at 2 f by about w dt / 2, the velocity's half substep,
        // which a hundred periods wash out.
        std::array<DecayFit, kModes> fit;
        const double end = t60_of_decay(*std::min_element(decays.begin(), decays.end())) / 3;
        for (double t = 0; t < end; t += step) {
            const auto a = amplitudes(body, modes);
            for (std::size_t k = 0; k < kModes; ++k)
                if (t < t60_of_decay(decays[k]) / 3)
                    fit[k].add(t, a[k]);
            soft.step(step, dWorldStep);
        }
        ASSERT_FALSE(body.stopped());
        for (std::size_t k = 0; k < kModes; ++k) {
            ASSERT_GT(fit[k].n, 300);
            const double t60 = t60_of_decay(decays[k]);
            EXPECT_NEAR(t60_of_decay(fit[k].decay()), t60, 0.01 * t60)
                << "order " << r.form.order << ", " << modes.frequency[k] << " Hz";
            testing::Test::RecordProperty(
                "error_per_mille_" + std::to_string(k),
                std::to_string(1000 * (t60_of_decay(fit[k].decay()) / t60 - 1)));
        }
        EXPECT_LE((body.linear_momentum() - linear).norm(),
                  1e-12 * body.total_mass() * (0.1 + 0.1 * r.spin.norm()));
        EXPECT_LE((body.angular_momentum() - angular).norm(),
                  1e-12 * body.total_mass() * 0.1 * (0.1 + 0.1 * r.spin.norm()));
    }
    dSpaceDestroy(space);
    dWorldDestroy(world);
    dCloseODE();
}

Expected by_solids(std::vector<Solid> solids) {
    return [solids](const TetMesh& mesh, const ModalModel& modes) {
        return modal_decays(mesh, solids, modes);
    };
}
Expected by_rayleigh(double alpha, double beta) {
    return [=](const TetMesh&, const ModalModel& modes) {
        std::vector<double> out;
        for (const double f : modes.frequency)
            out.push_back(RayleighDamping{alpha, beta}.decay(f));
        return out;
    };
}

TEST(Decay, OfMassProportionalDampingIsWithinOnePercent) {
    Ringing r;
    r.solids[0].alpha = 300;
    rings_down_as_predicted(r, by_rayleigh(300, 0));
}

TEST(Decay, OfStiffnessProportionalDampingIsWithinOnePercent) {
    Ringing r;
    r.solids[0].beta = 1.5e-7;
    rings_down_as_predicted(r, by_rayleigh(0, 1.5e-7));
}

TEST(Decay, OfRayleighDampingIsWithinOnePercentInQuadraticElements) {
    Ringing r;
    r.form.order = 2;
    r.solids[0].alpha = 150;
    r.solids[0].beta = 1.5e-7;
    rings_down_as_predicted(r, by_rayleigh(150, 1.5e-7));
}

/// Order of the elements, and spin about an axis of no symmetry [rad/s].
class ModalDecay : public testing::TestWithParam<std::pair<int, double>> {
protected:
    ModalDecay() {
        r_.form.order = GetParam().first;
        r_.spin = GetParam().second * Vec3(1, 2, -1).normalized();
        setenv("ODE_SOFTBODY_CACHE", "", 1);
    }
    Ringing r_;
};

TEST_P(ModalDecay, OfRayleighDampingIsWithinOnePercent) {
    r_.solids[0].alpha = 150;
    r_.solids[0].beta = 1.5e-7;
    r_.form.modal_damping = true;
    rings_down_as_predicted(r_, by_rayleigh(150, 1.5e-7));
}

TEST_P(ModalDecay, OfALossFactorIsWithinOnePercent) {
    r_.solids[0].loss_factor = 0.01;
    rings_down_as_predicted(r_, [](const TetMesh&, const ModalModel& modes) {
        std::vector<double> out;
        for (const double f : modes.frequency)
            out.push_back(std::numbers::pi * f * 0.01);
        return out;
    });
}

// A middle mode that rings longer than its neighbours: no law of a material does that.
TEST_P(ModalDecay, OfATableIsWithinOnePercent) {
    const std::vector<double> decay{300, 120, 400};
    ModalOptions options;
    options.order = r_.form.order;
    options.mass = MassKind::kLumped;
    options.estimate = false;
    options.max_frequency = 1e6;
    options.max_modes = kModes;
    const ModalModel modes = solve_modes(r_.mesh, r_.solids, options);
    std::vector<double> t60;
    for (const double d : decay)
        t60.push_back(t60_of_decay(d));
    r_.form.damping_table = DampingTable(modes.frequency, t60);
    rings_down_as_predicted(r_, [&](const TetMesh&, const ModalModel&) { return decay; });
}

INSTANTIATE_TEST_SUITE_P(All, ModalDecay,
                         testing::Values(std::pair{1, 0.0}, std::pair{1, 100.0}, std::pair{2, 0.0},
                                         std::pair{2, 100.0}),
                         [](const auto& instance) {
                             return std::string(instance.param.first == 1 ? "Linear"
                                                                          : "Quadratic") +
                                    (instance.param.second > 0 ? "Spinning" : "");
                         });

/// The half of the bar beyond its middle is of another solid.
Ringing two_solids(int order) {
    Ringing r;
    r.mesh = make_bar(0.1, 0.02, 0.01, 6, 1, 1);
    r.form.order = order;
    r.solids.push_back(steel());
    r.solids[1].young = 70e9;
    r.solids[1].density = 2700;
    r.mesh.group_name = {"steel", "aluminium"};
    for (std::size_t e = 0; e < r.mesh.element_count(); ++e) {
        double x = 0;
        for (const int node : r.mesh.nodes_of(e))
            x += r.mesh.node[static_cast<std::size_t>(node)].x() / 4;
        r.mesh.group.push_back(x > 0.05 ? 1 : 0);
    }
    return r;
}

// Viscous stress in one half of the bar only, and of volume change only: the shares of energy that
// modal_decays() takes predict what the stress itself does, but for the square of the damping (1 %
// at twice this phi).
TEST(Decay, OfTwoSolidsFollowsTheirSharesOfEnergy) {
    for (const int order : {1, 2}) {
        Ringing r = two_solids(order);
        r.solids[0].beta = 1e-8;
        r.solids[1].beta = 2e-7;
        r.solids[0].alpha = 300;
        rings_down_as_predicted(r, by_solids(r.solids));
        r = two_solids(order);
        for (Solid& s : r.solids)
            s.phi = 5e4;
        rings_down_as_predicted(r, by_solids(r.solids));
    }
}

TEST(Decay, OfTwoSolidsIsTheSameByModes) {
    setenv("ODE_SOFTBODY_CACHE", "", 1);
    Ringing r = two_solids(2);
    r.solids[0].loss_factor = 0.004;
    r.solids[1].loss_factor = 0.02;
    r.solids[1].beta = 1e-7;
    rings_down_as_predicted(r, by_solids(r.solids));
}

} // namespace
} // namespace ode::soft
