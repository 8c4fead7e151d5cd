#include "integrate/central_difference.h"

#include "integrate/oscillator.h"
#include "unit/model/specimens.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ode::soft {
namespace {

struct Swing {
    Oscillator springs;
    std::vector<double> inverse_mass;
    NodeInertia inertia;
    NodeState state;
    NodeArray force;
    CentralDifference method;

    Swing(double square, double damping, double alpha)
        : springs(std::sqrt(square), damping / (2 * std::sqrt(square))),
          inverse_mass{1.0}, inertia{inverse_mass, alpha}, state{NodeArray(1), NodeArray(1)},
          force(1) {}

    void begin(double h) {
        force.set_zero();
        method.begin(springs, inertia, h, state, force);
    }
    void end(double h) {
        force.set_zero();
        method.end(springs, inertia, h, state, force);
    }
    void step(double h) {
        force.set_zero();
        method.evaluate(springs, state, force);
        method.step(springs, inertia, h, state, force);
    }
};

// x_n = cos(n theta) with cos(theta) = 1 - (w h)^2 / 2, exactly: the method's own closed form.
TEST(CentralDifference, FollowsItsClosedFormOnAnOscillator) {
    const double w = 3, h = 0.4;
    Swing run(w * w, 0, 0);
    run.state.position[0] = Vec3(1, 0, -2);
    run.begin(h);
    const double theta = std::acos(1 - w * w * h * h / 2);
    for (int n = 1; n <= 1000; ++n) {
        run.step(h);
        // Rounding grows linearly: 1e-16 a step, amplified by 1/sin(theta) = 1.04.
        ASSERT_NEAR(run.state.position[0][0], std::cos(n * theta), 2e-16 * n * 4) << n;
        ASSERT_NEAR(run.state.position[0][2], -2 * std::cos(n * theta), 2e-16 * n * 8) << n;
    }
}

// The product of the roots of z^2 - (1 + e - ..) z + e is e = exp(-alpha h): every mode decays by
// exp(-alpha h / 2) a step, at any frequency.
TEST(CentralDifference, AlphaDecaysEveryModeExactly) {
    for (const double w : {0.5, 5.0}) {
        const double h = 0.3, alpha = 0.2;
        Swing run(w * w, 0, alpha);
        run.state.velocity[0] = Vec3(1, 1, 1);
        // x0, x1, x2 of a two-term recurrence: its determinant ratio is the product of the roots.
        double x[4];
        for (double& xi : x) {
            run.step(h);
            xi = run.state.position[0][0];
        }
        const double before = x[0] * x[2] - x[1] * x[1], after = x[1] * x[3] - x[2] * x[2];
        EXPECT_NEAR(after / before, std::exp(-alpha * h), 1e-13);
    }
}

TEST(CentralDifference, BeginAndEndUndoEachOther) {
    const double h = 0.2;
    Swing run(4, 0, 0.3);
    run.state.position[0] = Vec3(1, 2, 3);
    run.state.velocity[0] = Vec3(-1, 0.5, 2);
    run.begin(h);
    EXPECT_GT((run.state.velocity[0] - Vec3(-1, 0.5, 2)).norm(), 0.1);
    run.end(h);
    EXPECT_LE((run.state.velocity[0] - Vec3(-1, 0.5, 2)).norm(), 1e-15 * 4);
}

// Second order: started and ended synchronously, halving the step quarters the error.
TEST(CentralDifference, IsOfSecondOrder) {
    double error[2];
    for (int refined = 0; refined < 2; ++refined) {
        const int steps = refined ? 200 : 100;
        const double h = 2.0 / steps;
        Swing run(9, 0, 0);
        run.state.position[0] = Vec3(1, 0, 0);
        run.state.velocity[0] = Vec3(2, 0, 0);
        run.begin(h);
        for (int n = 0; n < steps; ++n)
            run.step(h);
        run.end(h);
        const double exact = std::cos(6.0) + 2.0 / 3 * std::sin(6.0);
        const double speed = -3 * std::sin(6.0) + 2 * std::cos(6.0);
        error[refined] =
            std::hypot(run.state.position[0][0] - exact, (run.state.velocity[0][0] - speed) / 3);
    }
    EXPECT_NEAR(error[0] / error[1], 4, 0.05);
}

// h = sqrt(beta^2 + 4/w^2) - beta is the exact limit, from both sides.
TEST(CentralDifference, IsStableExactlyBelowTheCriticalStep) {
    for (const double beta : {0.0, 0.05, 1.0}) {
        const double w = 4;
        const double limit = std::sqrt(beta * beta + 4 / (w * w)) - beta;
        for (const double share : {0.999, 1.001}) {
            Swing run(w * w, beta * w * w, 0);
            run.state.position[0] = Vec3(1, 1, 1);
            for (int n = 0; n < 20000; ++n) {
                run.step(share * limit);
                if (!(peak(run.state.position) < 1e6))
                    break;
            }
            // Undamped below the limit the closed form is bounded by 1/sin(theta), here 16.
            if (share < 1)
                EXPECT_LE(peak(run.state.position), 40) << beta;
            else
                EXPECT_GT(peak(run.state.position), 1e5) << beta;
        }
    }
}

TEST(CentralDifference, HeldNodesKeepTheirVelocity) {
    std::vector<double> inverse_mass = {0.0, 0.5};
    const NodeInertia inertia{inverse_mass, 0.7};
    NodeState state{NodeArray(2), NodeArray(2)};
    NodeArray force(2);
    state.velocity[0] = Vec3(1, 2, 3);
    for (std::size_t i = 0; i < 2; ++i)
        force[i] = Vec3(10, 20, 30);
    kick_drift(inertia, 0.1, force, state);
    EXPECT_EQ(Vec3(state.velocity[0]), Vec3(1, 2, 3));
    EXPECT_LE((state.position[0] - Vec3(0.1, 0.2, 0.3)).norm(), 1e-16);
    const double gain = (1 - std::exp(-0.07)) / 0.7;
    EXPECT_LE((state.velocity[1] - gain * Vec3(5, 10, 15)).norm(), 1e-14);
    EXPECT_EQ(state.position.data()[3], 0);
    EXPECT_EQ(state.velocity.data()[7], 0);
}

} // namespace
} // namespace ode::soft
