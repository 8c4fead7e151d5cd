// Rigid shapes thrown on a free, elastic, frictionless plate: what is kept, what leaks, what
// pierces.
#include "couple/node_contact.h"
#include "integrate/central_difference.h"
#include "mesh/generate.h"
#include "model/stvk_linear.h"

#include <gtest/gtest.h>
#include <ode/ode.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

namespace ode::soft {
namespace {

constexpr double kMass = 0.3;

struct Outcome {
    double energy_error; ///< at the end, of the initial energy
    double depth;        ///< deepest corner or ball point below the plate's face [m]
    double away;         ///< speed of the rigid body along +z at the end [m/s]
};

/// A plate of 20 x 20 x 2 cm, mesh 2 cm, 1000 kg/m^3, 20 MPa, undamped and free.
class Scene {
public:
    explicit Scene(double dt)
        : dt_(dt), mesh_(make_plate(0.2, 0.2, 0.02, 10, 10, 1)), surface_(extract_surface(mesh_)),
          model_(mesh_, solid()), nodes_(mesh_, surface_, model_.mass()) {
        const std::size_t n = mesh_.node.size();
        state_ = {NodeArray(n), NodeArray(n)};
        force_ = NodeArray(n);
        for (std::size_t i = 0; i < n; ++i)
            state_.position[i] = mesh_.node[i];
        for (const double m : model_.mass())
            inverse_mass_.push_back(1 / m);
        dInitODE2(0);
        world_ = dWorldCreate();
    }
    ~Scene() {
        dWorldDestroy(world_);
        dCloseODE();
    }

    static Solid solid() {
        Solid s;
        s.young = 2e7;
        s.poisson = 0.3;
        s.density = 1000;
        return s;
    }

    Outcome throw_on(RigidShape shape, const dMass& mass, const Vec3& at, const Vec3& velocity,
                     const Quat& turn, const Vec3& spin, double seconds) {
        const dBodyID body = dBodyCreate(world_);
        dBodySetMass(body, &mass);
        const dQuaternion q{turn.w(), turn.x(), turn.y(), turn.z()};
        dBodySetPosition(body, at.x(), at.y(), at.z());
        dBodySetQuaternion(body, q);
        dBodySetLinearVel(body, velocity.x(), velocity.y(), velocity.z());
        dBodySetAngularVel(body, spin.x(), spin.y(), spin.z());
        shape.body = body;
        RigidShadow shadow(body, seconds, dt_);
        NodeContact contact(nodes_, nullptr);
        ContactLaw law;
        law.friction = 0;
        law.damping = 0;
        contact.begin_step(shape, law, inverse_mass_, dt_);
        const auto energy = [&] {
            const RigidMotion& m = shadow.motion();
            const Vec3 w = m.pose.rotation.transpose() * m.spin;
            double sum = mass.mass * m.velocity.squaredNorm() / 2 +
                         w.dot(Vec3(mass.I[0], mass.I[5], mass.I[10]).asDiagonal() * w) / 2 +
                         model_.energy(state_.position);
            for (std::size_t i = 0; i < mesh_.node.size(); ++i)
                sum += state_.velocity[i].squaredNorm() / inverse_mass_[i] / 2;
            return sum;
        };
        const double start = energy();
        CentralDifference integrator;
        Outcome out{};
        const auto samples = sample_shape(shape, 0.01);
        for (double t = 0; t < seconds; t += dt_) {
            force_.set_zero();
            integrator.evaluate(model_, state_, force_);
            contact.add_force(state_.position, state_.velocity, shadow, dt_, force_);
            shadow.advance(dt_);
            integrator.step(model_, {inverse_mass_, 0}, dt_, state_, force_);
            // Against the mean height of the plate's upper face, near enough for a bound.
            for (const RigidSample& s : samples) {
                const Vec3 p = shadow.motion().pose.to_world(s.center);
                if (p.head<2>().cwiseAbs().maxCoeff() < 0.09)
                    out.depth = std::fmax(out.depth, face_height(p) - (p.z() - s.radius));
            }
        }
        out.energy_error = energy() / start - 1;
        out.away = shadow.motion().velocity.z();
        dBodyDestroy(body);
        return out;
    }

private:
    /// Height of the upper face at p, from the triangle above or below it.
    double face_height(const Vec3& p) const {
        double height = -1;
        for (const auto& t : surface_.triangle) {
            const Vec3 a = state_.position[static_cast<std::size_t>(t[0])];
            const Vec3 b = state_.position[static_cast<std::size_t>(t[1])];
            const Vec3 c = state_.position[static_cast<std::size_t>(t[2])];
            const Vec3 n = (b - a).cross(c - a);
            if (n.z() <= 0)
                continue;
            const auto side = [&](const Vec3& u, const Vec3& v) {
                return (v.x() - u.x()) * (p.y() - u.y()) - (v.y() - u.y()) * (p.x() - u.x());
            };
            if (side(a, b) >= 0 && side(b, c) >= 0 && side(c, a) >= 0)
                height = std::fmax(
                    height, a.z() - (n.x() * (p.x() - a.x()) + n.y() * (p.y() - a.y())) / n.z());
        }
        return height;
    }

    double dt_;
    TetMesh mesh_;
    Surface surface_;
    StvkLinear model_;
    SurfaceNodes nodes_;
    NodeState state_;
    NodeArray force_;
    std::vector<double> inverse_mass_;
    dWorldID world_;
};

RigidShape shape_of(ShapeKind kind, const Vec3& size) {
    RigidShape shape;
    shape.kind = kind;
    shape.size = size;
    return shape;
}

// Twenty-four random throws of a tilted, spinning box at 2 m/s. Corners bear on faces by the signed
// closest point, faces on nodes by the box's distance.
TEST(ThrownShape, BoxKeepsItsEnergyAndDoesNotPierce) {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    double sum = 0;
    double gain = 0;
    double loss = 0;
    double depth = 0;
    const int throws = 24;
    for (int i = 0; i < throws; ++i) {
        Scene scene(1e-5);
        dMass mass;
        dMassSetBoxTotal(&mass, kMass, 0.06, 0.05, 0.04);
        const Quat turn =
            Quat(normal(random), normal(random), normal(random), normal(random)).normalized();
        const Vec3 spin = 10 * Vec3(normal(random), normal(random), normal(random));
        const Outcome o = scene.throw_on(shape_of(ShapeKind::box, {0.03, 0.025, 0.02}), mass,
                                         {0.013, -0.007, 0.06}, {0.1, 0.2, -2}, turn, spin, 0.04);
        sum += std::fabs(o.energy_error);
        gain = std::fmax(gain, o.energy_error);
        loss = std::fmin(loss, o.energy_error);
        depth = std::fmax(depth, o.depth);
    }
    std::printf("box: energy error mean %.2e, worst %+.2e %+.2e; deepest corner %.2f mm\n",
                sum / throws, gain, loss, 1e3 * depth);
    EXPECT_LT(sum / throws, 5e-3);
    EXPECT_LT(gain, 1e-2);
    EXPECT_LT(depth, 4e-3);
}

// Onto the middle of a face: no node is within its radius.
TEST(ThrownShape, SmallBallBouncesBetweenNodes) {
    Scene scene(1e-5);
    dMass mass;
    dMassSetSphereTotal(&mass, 0.004, 0.005);
    const Outcome o =
        scene.throw_on(shape_of(ShapeKind::sphere, {0.005, 0, 0}), mass, {0.0133, 0.0067, 0.02},
                       {0, 0, -2}, Quat::Identity(), Vec3::Zero(), 0.02);
    std::printf("ball: energy error %+.2e; depth %.2f mm; leaves at %.2f m/s\n", o.energy_error,
                1e3 * o.depth, o.away);
    EXPECT_GT(o.away, 0);
    EXPECT_LT(std::fabs(o.energy_error), 5e-3);
}

struct Shot {
    ShapeKind kind;
    Vec3 size;
};

class Fast : public testing::TestWithParam<Shot> {};

// 100 m/s is 1 mm a substep against a plate of 20 mm, and 0.7 of the plate's wave speed. A few
// grams, so that the plate could stop them at all. What keeps the explicit friction and dashpots
// of a light body stable must not soften the spring in the middle of an impact: the box lost 45 %.
TEST_P(Fast, DoesNotTunnel) {
    const auto& [kind, size] = GetParam();
    Scene scene(1e-5);
    dMass mass;
    dMassSetBoxTotal(&mass, 0.002, 2 * size.x(), 2 * size.x(), 2 * size.x());
    const Outcome o =
        scene.throw_on(shape_of(kind, size), mass, {0.0133, 0.0067, 0.05}, {0, 0, -100},
                       Quat(0.9, 0.3, 0.2, 0.1).normalized(), Vec3::Zero(), 0.003);
    std::printf("fast %d: leaves at %.1f m/s, depth %.1f mm, energy %+.2e\n",
                static_cast<int>(kind), o.away, 1e3 * o.depth, o.energy_error);
    // A light body's springs are softened while they bear, which only loses: up to 45 % here.
    // Unsoftened these cases keep 98 % and more, but a 0.1 kg plate under a falling box gained four
    // times the energy of the fall, and thrown cards more.
    EXPECT_LT(o.energy_error, 0.01);
    EXPECT_GT(o.energy_error, -0.5);
    EXPECT_GT(o.away, -5); // the plate's own speed once it has all of the momentum: 0.25 m/s
}

INSTANTIATE_TEST_SUITE_P(Shapes, Fast,
                         testing::Values(Shot{ShapeKind::sphere, {0.005, 0, 0}},
                                         Shot{ShapeKind::box, {0.005, 0.005, 0.005}},
                                         Shot{ShapeKind::capsule, {0.003, 0, 0.005}},
                                         Shot{ShapeKind::cylinder, {0.005, 0, 0.005}}));

} // namespace
} // namespace ode::soft
