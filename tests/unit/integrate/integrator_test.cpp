// What holds for every named method, and what the lecture says of each (physics.md 6).
#include "integrate/integrator.h"

#include "base/error.h"
#include "integrate/oscillator.h"
#include "model/make_model.h"
#include "unit/model/specimens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

namespace ode::soft {
namespace {

/// One body under one method, from and to velocities at the time of the positions.
struct Motion {
    const ElasticModel& model;
    std::vector<double> inverse_mass;
    NodeState state;
    NodeArray load, force;
    std::unique_ptr<Integrator> method;

    Motion(const ElasticModel& m, std::string_view name)
        : model(m), state{NodeArray(m.node_count()), NodeArray(m.node_count())},
          load(m.node_count()), force(m.node_count()),
          method(integrator_kind(name).make(m.node_count())) {
        for (const double mass : m.mass())
            inverse_mass.push_back(1 / mass);
    }

    /// @return whether no step failed.
    bool go(double h, int steps, double alpha = 0) {
        const NodeInertia inertia{inverse_mass, alpha};
        const auto put_load = [&] { std::copy_n(load.data(), 4 * load.size(), force.data()); };
        put_load();
        method->begin(model, inertia, h, state, force);
        for (int n = 0; n < steps; ++n) {
            put_load();
            method->evaluate(model, state, force);
            if (!std::isfinite(method->step(model, inertia, h, state, force).max_stretch))
                return false;
        }
        put_load();
        method->end(model, inertia, h, state, force);
        return true;
    }
};

/// Duffing's spring, x'' = -x - x^3 on each axis: the simplest force that bends.
class HardSpring final : public ElasticModel {
public:
    std::size_t node_count() const noexcept override { return 1; }
    std::span<const double> mass() const noexcept override { return {&kMass, 1}; }
    StrainExtremes add_force(const NodeArray& x, const NodeArray&,
                             NodeArray& force) const noexcept override {
        const Eigen::Array3d a = x[0].array();
        force[0].array() -= a + a.cube();
        return {};
    }
    double energy(const NodeArray& x) const noexcept override {
        const Eigen::Array3d a = x[0].array().square();
        return (a / 2 + a.square() / 4).sum();
    }
    BlockMatrix tangent_pattern() const override {
        static constexpr int kNode = 0;
        return BlockMatrix({&kNode, 1}, 1, 1);
    }
    void add_tangent(const NodeArray& x, double elastic, double,
                     BlockMatrix& out) const noexcept override {
        const Vec3 k = 1 + 3 * x[0].array().square();
        out.add(0, 0, elastic * Mat3(k.asDiagonal()));
    }
    Eigen::SparseMatrix<double> consistent_mass() const override { return stiffness(NodeArray(1)); }
    double max_frequency_bound() const override { return 1; }

private:
    static constexpr double kMass = 1;
};

/// Jacobi's cn(u, m) by descending Landen transformation (Abramowitz & Stegun 16.4).
double jacobi_cn(double u, double m) {
    double a[16] = {1}, c[16] = {std::sqrt(m)};
    double b = std::sqrt(1 - m);
    int n = 0;
    for (; n < 15 && std::abs(c[n]) > 1e-16; ++n) {
        a[n + 1] = (a[n] + b) / 2;
        c[n + 1] = (a[n] - b) / 2;
        b = std::sqrt(a[n] * b);
    }
    double phi = std::exp2(n) * a[n] * u;
    for (; n > 0; --n)
        phi = (std::asin(c[n] * std::sin(phi) / a[n]) + phi) / 2;
    return std::cos(phi);
}

class EveryMethod : public testing::TestWithParam<std::string> {
protected:
    const IntegratorKind& kind() const { return integrator_kind(GetParam()); }

    /// Place and velocity on the first axis after `time` in `steps` steps.
    Eigen::Vector2d after(const ElasticModel& model, const Eigen::Vector2d& start, double time,
                          int steps, double alpha = 0) {
        Motion run(model, GetParam());
        run.state.position[0].x() = start[0];
        run.state.velocity[0].x() = start[1];
        EXPECT_TRUE(run.go(time / steps, steps, alpha));
        return {run.state.position[0].x(), run.state.velocity[0].x()};
    }

    /// Halving a small step divides the error by 2^order, up to terms of the next order.
    template <class Error>
    void expect_order(Error error_of, int steps, int order) {
        const double ratio = error_of(steps) / error_of(2 * steps);
        EXPECT_NEAR(std::log2(ratio), order, 0.06) << error_of(2 * steps);
    }
};

/// x'' + 2 zeta w x' + w^2 x = 0 from x = 1, x' = 2: exp(-d t) (cos wd t + (2 + d) / wd sin wd t),
/// d = zeta w.
Eigen::Vector2d oscillation(double w, double zeta, double t) {
    const double d = zeta * w, wd = w * std::sqrt(1 - zeta * zeta), b = (2 + d) / wd;
    const double c = std::cos(wd * t), s = std::sin(wd * t);
    return std::exp(-d * t) * Eigen::Vector2d(c + b * s, (b * wd - d) * c - (wd + b * d) * s);
}

TEST_P(EveryMethod, ConvergesOnAnOscillatorAtItsOrder) {
    const Oscillator model(3, 0);
    const auto error = [&](int n) {
        return (after(model, {1, 2}, 2, n) - oscillation(3, 0, 2)).norm();
    };
    expect_order(error, kind().order == 4 ? 100 : 800, kind().order);
}

TEST_P(EveryMethod, ConvergesOnADampedOscillatorAtItsOrder) {
    const Oscillator model(3, 0.2);
    const auto error = [&](int n) {
        return (after(model, {1, 2}, 2, n) - oscillation(3, 0.2, 2)).norm();
    };
    // Central difference lags the viscous force by half a step: of first order in the damping.
    expect_order(error, kind().order == 4 ? 100 : 1600,
                 GetParam() == "central-difference" ? 1 : kind().order);
}

// The same by mass-proportional damping, alpha = 2 zeta w.
TEST_P(EveryMethod, ConvergesWithMassProportionalDamping) {
    const Oscillator model(3, 0);
    const auto error = [&](int n) {
        return (after(model, {1, 2}, 2, n, 2 * 0.2 * 3) - oscillation(3, 0.2, 2)).norm();
    };
    expect_order(error, kind().order == 4 ? 100 : 1600, kind().order);
}

// The lecture's rotation field, x' = w (-y, x): place and velocity / w of an oscillator turn in
// their plane. Not once round: a symplectic method returns to its start to a higher order.
TEST_P(EveryMethod, TurnsTheRotationFieldAtItsOrder) {
    const double w = 2 * std::numbers::pi, turn = w * 0.7;
    const Oscillator model(w, 0);
    const auto miss = [&](int n) {
        const Eigen::Vector2d end = after(model, {1, 0}, 0.7, n);
        return std::hypot(end[0] - std::cos(turn), end[1] / w + std::sin(turn));
    };
    expect_order(miss, kind().order == 4 ? 200 : 3200, kind().order);
}

// x = A cn(W t, m), W^2 = 1 + A^2, m = A^2 / (2 W^2) for x'' = -x - x^3 from rest at A.
TEST_P(EveryMethod, ConvergesOnANonLinearSpringAtItsOrder) {
    const HardSpring model;
    const double amplitude = 1.5, rate2 = 1 + amplitude * amplitude, t = 3;
    const double m = amplitude * amplitude / (2 * rate2);
    const double exact = amplitude * jacobi_cn(std::sqrt(rate2) * t, m);
    const auto error = [&](int n) {
        return std::abs(after(model, {amplitude, 0}, t, n)[0] - exact);
    };
    expect_order(error, kind().order == 4 ? 150 : 3200, kind().order);
}

// x = load / (m w^2) (1 - cos w t).
TEST_P(EveryMethod, TakesConstantLoads) {
    const Oscillator model(3, 0);
    Motion run(model, GetParam());
    run.load[0] = Vec3(4, 0, 0);
    ASSERT_TRUE(run.go(2.0 / 4000, 4000));
    const double tolerance = kind().order == 1 ? 5e-3 : 2e-6;
    EXPECT_NEAR(run.state.position[0].x(), 4.0 / 9 * (1 - std::cos(6.0)), tolerance);
}

// Through the real solid: a block in flight keeps its momenta, at a step that is small to all.
TEST_P(EveryMethod, KeepsMomentaOfAFlyingBlock) {
    const TetMesh mesh = box_mesh({0.2, 0.1, 0.1}, 2, 1, 1);
    for (const std::string_view law : {"stvk", "stable-neo-hookean"}) {
        const auto model = make_model(law, mesh, {{viscous_rubber()}});
        Motion run(*model, GetParam());
        run.state.position = disturbed(node_array(mesh.node), 2e-3, 3);
        const auto momenta = [&] {
            Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
            for (std::size_t i = 0; i < model->node_count(); ++i) {
                const Vec3 p = model->mass()[i] * run.state.velocity[i];
                sum.head<3>() += p;
                sum.tail<3>() += run.state.position[i].cross(p);
            }
            return sum;
        };
        for (std::size_t i = 0; i < model->node_count(); ++i)
            run.state.velocity[i] =
                Vec3(1, 2, 3) + Vec3(4, -3, 2).cross(Vec3(run.state.position[i]));
        const auto before = momenta();
        const double h = 5e-6;
        ASSERT_TRUE(run.go(h, 200));
        const auto after = momenta();
        // Newton stops at 1e-14 of the extent over h, a node: 1e-14 * 0.2 / 5e-6 = 4e-10 m/s.
        const double scale = before.head<3>().norm();
        EXPECT_LE((after - before).head<3>().norm(), 1e-9 * scale) << law;
        // Angular momentum is kept by the symplectic methods and by trapezoidal's mean only up to
        // their order; 200 steps of w h = 0.02 for the lowest mode.
        EXPECT_LE((after - before).tail<3>().norm(), 2e-3 * before.tail<3>().norm()) << law;
    }
}

TEST_P(EveryMethod, LeavesHeldNodesAlone) {
    const TetMesh mesh = box_mesh({0.2, 0.1, 0.1}, 2, 1, 1);
    const auto model = make_model("stvk", mesh, {{viscous_rubber()}});
    Motion run(*model, GetParam());
    run.state.position = disturbed(node_array(mesh.node), 1e-3, 3);
    run.inverse_mass[1] = run.inverse_mass[4] = 0;
    run.state.velocity[4] = Vec3(0.1, 0, 0);
    const Vec3 still = run.state.position[1], moving = run.state.position[4];
    ASSERT_TRUE(run.go(1e-5, 50, 3.0));
    EXPECT_EQ(Vec3(run.state.position[1]), still);
    EXPECT_LE((run.state.position[4] - moving - Vec3(0.1 * 50e-5, 0, 0)).norm(), 1e-14);
    EXPECT_EQ(Vec3(run.state.velocity[4]), Vec3(0.1, 0, 0));
}

INSTANTIATE_TEST_SUITE_P(Integrators, EveryMethod, testing::ValuesIn([] {
                             std::vector<std::string> names;
                             for (const IntegratorKind& kind : integrator_kinds())
                                 names.emplace_back(kind.name);
                             return names;
                         }()),
                         [](const auto& instance) {
                             std::string name = instance.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

// L: "Euler integration is particularly bad": on a rotation it spirals out, by sqrt(1 + (w h)^2).
TEST(ExplicitEuler, SpiralsOutAsItsClosedFormSays) {
    const Oscillator model(1, 0);
    Motion run(model, "explicit-euler");
    run.state.position[0] = Vec3(1, 0, 0);
    run.go(0.1, 100);
    EXPECT_NEAR(std::hypot(run.state.position[0].x(), run.state.velocity[0].x()),
                std::pow(1.01, 50), 1e-12);
}

// L: "explicit methods can be conditionally stable", "fully implicit can be unconditionally
// stable", "may still have large errors": its error shows as damping.
TEST(BackwardEuler, IsStableAtAnyStepAndDamps) {
    for (const double wh : {0.1, 1.0, 100.0}) {
        const Oscillator model(1, 0);
        Motion run(model, "backward-euler");
        run.state.position[0] = Vec3(1, 0, 0);
        run.go(wh, 10);
        EXPECT_NEAR(std::hypot(run.state.position[0].x(), run.state.velocity[0].x()),
                    std::pow(1 + wh * wh, -5), 1e-10);
    }
    const HardSpring hard;
    for (const double h : {1.0, 30.0}) {
        Motion run(hard, "backward-euler");
        run.state.position[0] = Vec3(0.5, -20, 3);
        run.state.velocity[0] = Vec3(40, 5, 0);
        ASSERT_TRUE(run.go(h, 200)) << h;
        EXPECT_LE(run.state.position[0].norm(), 0.1) << h;
    }
}

// L: "semi-implicit can be conditionally stable; nonlinearities can cause instability": the same
// spring that backward Euler calms is thrown about, because the tangent at the start of the step is
// softer than what the step runs into.
TEST(LinearisedBackwardEuler, EqualsBackwardEulerOnALinearBodyOnly) {
    const Oscillator linear(2, 0.1);
    Motion a(linear, "backward-euler"), b(linear, "linearised-backward-euler");
    for (Motion* run : {&a, &b}) {
        run->state.position[0] = Vec3(1, 2, 3);
        run->go(0.7, 5);
    }
    EXPECT_LE((a.state.position[0] - b.state.position[0]).norm(), 1e-13);

    const HardSpring hard;
    Motion full(hard, "backward-euler"), half(hard, "linearised-backward-euler");
    for (Motion* run : {&full, &half}) {
        run->state.velocity[0] = Vec3(40, 0, 0);
        ASSERT_TRUE(run->go(1.0, 3));
    }
    const auto energy = [&](const Motion& run) {
        return run.state.velocity[0].squaredNorm() / 2 + hard.energy(run.state.position);
    };
    EXPECT_LE(energy(full), 800);
    EXPECT_GE(energy(half), 800);
}

TEST(Integrator, IsMadeByNameAndListsTheNames) {
    EXPECT_EQ(integrator_kind("verlet").name, "central-difference");
    try {
        integrator_kind("leapfrgo");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::strstr(error.what(), "leapfrgo"), nullptr);
        EXPECT_NE(std::strstr(error.what(), "tr-bdf2"), nullptr);
    }
}

} // namespace
} // namespace ode::soft
