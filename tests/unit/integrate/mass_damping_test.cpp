#include "integrate/mass_damping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace ode::soft {
namespace {

constexpr std::size_t kNodes = 7;

struct Cloud {
    NodeState state{NodeArray(kNodes), NodeArray(kNodes)};
    std::vector<double> mass;
    std::vector<double> inverse_mass;
    std::vector<int> held;

    Cloud() {
        for (std::size_t i = 0; i < kNodes; ++i) {
            const double t = static_cast<double>(i);
            state.position[i] = Vec3(std::sin(3 * t), std::cos(5 * t), std::sin(7 * t + 1));
            mass.push_back(1 + 0.3 * t);
            inverse_mass.push_back(1 / mass.back());
        }
    }

    void move_rigidly(const Vec3& velocity, const Vec3& spin) {
        for (std::size_t i = 0; i < kNodes; ++i)
            state.velocity[i] = velocity + spin.cross(state.position[i]);
    }

    void damp(double alpha, double dt) {
        damp_deformation(mass, inverse_mass, held, {&alpha, 1}, dt, state);
    }
    void hold(int node) {
        held.push_back(node);
        inverse_mass[static_cast<std::size_t>(node)] = 0;
        state.velocity[static_cast<std::size_t>(node)].setZero();
    }

    Vec3 momentum() const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < kNodes; ++i)
            sum += mass[i] * state.velocity[i];
        return sum;
    }
    Vec3 angular_momentum() const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < kNodes; ++i)
            sum += mass[i] * state.position[i].cross(state.velocity[i]);
        return sum;
    }
};

constexpr double kRounding = 1e-13; // momenta here are of order 10

TEST(MassDamping, LeavesRigidMotionAlone) {
    Cloud cloud;
    cloud.move_rigidly({1, -2, 3}, {4, 5, -6});
    const NodeArray before = cloud.state.velocity;
    cloud.damp(5, 0.1);
    for (std::size_t i = 0; i < kNodes; ++i)
        EXPECT_NEAR((cloud.state.velocity[i] - before[i]).norm(), 0, kRounding) << i;
}

TEST(MassDamping, KeepsMomentaWhileDeformationDecaysByTheExponential) {
    Cloud cloud;
    cloud.move_rigidly({1, -2, 3}, {4, 5, -6});
    const NodeArray rigid = cloud.state.velocity;
    Cloud other;
    for (std::size_t i = 0; i < kNodes; ++i) {
        const double t = static_cast<double>(i);
        other.state.velocity[i] = rigid[i] + Vec3(std::cos(t), std::sin(2 * t), std::cos(4 * t));
    }
    const Vec3 p = other.momentum(), l = other.angular_momentum();
    Cloud stripped = other;
    stripped.damp(1e9, 1); // no deformation is left: the rigid fit
    Cloud damped = other;
    damped.damp(5, 0.1);
    EXPECT_NEAR((damped.momentum() - p).norm(), 0, 10 * kRounding);
    EXPECT_NEAR((damped.angular_momentum() - l).norm(), 0, 10 * kRounding);
    for (std::size_t i = 0; i < kNodes; ++i) {
        const Vec3 whole = other.state.velocity[i] - stripped.state.velocity[i];
        const Vec3 left = damped.state.velocity[i] - stripped.state.velocity[i];
        EXPECT_NEAR((left - std::exp(-0.5) * whole).norm(), 0, kRounding) << i;
    }
}

TEST(MassDamping, RatesThatDifferFromNodeToNodeKeepMomentaToo) {
    Cloud cloud;
    cloud.move_rigidly({1, -2, 3}, {4, 5, -6});
    std::vector<double> alpha;
    for (std::size_t i = 0; i < kNodes; ++i) {
        const double t = static_cast<double>(i);
        cloud.state.velocity[i] += Vec3(std::cos(t), std::sin(2 * t), std::cos(4 * t));
        alpha.push_back(i < 2 ? 0 : 3 * t);
    }
    const Cloud before = cloud;
    damp_deformation(cloud.mass, cloud.inverse_mass, {}, alpha, 0.1, cloud.state);
    EXPECT_NEAR((cloud.momentum() - before.momentum()).norm(), 0, 10 * kRounding);
    EXPECT_NEAR((cloud.angular_momentum() - before.angular_momentum()).norm(), 0, 10 * kRounding);
    for (std::size_t i = 0; i < kNodes; ++i) {
        const double change = (cloud.state.velocity[i] - before.state.velocity[i]).norm();
        EXPECT_EQ(change > 0, i >= 2) << i;
    }
}

TEST(MassDamping, ABodyHeldFastDecaysTowardsRest) {
    Cloud cloud;
    cloud.move_rigidly({1, -2, 3}, {4, 5, -6});
    for (const int node : {0, 3, 6})
        cloud.hold(node);
    const NodeArray before = cloud.state.velocity;
    cloud.damp(5, 0.1);
    for (std::size_t i = 0; i < kNodes; ++i) {
        const double left = cloud.inverse_mass[i] == 0 ? 1 : std::exp(-0.5);
        EXPECT_NEAR((cloud.state.velocity[i] - left * before[i]).norm(), 0, kRounding) << i;
    }
}

// Hung at a node it swings on; hung at two it swings about their line; and what isn't swinging, the
// bounce of the whole on its hook among it, decays.
TEST(MassDamping, ABodyThatHangsSwingsOnButDoesNotBounce) {
    for (const std::size_t hooks : {1u, 2u}) {
        Cloud swinging;
        const Vec3 pivot = swinging.state.position[2];
        const Vec3 spin = hooks == 1 ? Vec3(4, 5, -6) : Vec3(swinging.state.position[5] - pivot);
        swinging.move_rigidly(-spin.cross(pivot), spin);
        swinging.hold(2);
        if (hooks == 2)
            swinging.hold(5);
        const NodeArray before = swinging.state.velocity;
        swinging.damp(5, 0.1);
        for (std::size_t i = 0; i < kNodes; ++i)
            EXPECT_NEAR((swinging.state.velocity[i] - before[i]).norm(), 0, 10 * kRounding) << i;

        Cloud bouncing = swinging;
        double energy[2] = {0, 0};
        for (std::size_t i = 0; i < kNodes; ++i)
            if (bouncing.inverse_mass[i] > 0)
                bouncing.state.velocity[i] = bouncing.state.position[i] - pivot; // no spin in it
        for (double& e : energy) {
            for (std::size_t i = 0; i < kNodes; ++i)
                e += bouncing.mass[i] * bouncing.state.velocity[i].squaredNorm();
            bouncing.damp(5, 0.1);
        }
        EXPECT_NEAR(energy[1], std::exp(-1.0) * energy[0], 1e-12 * energy[0]);
    }
}

} // namespace
} // namespace ode::soft
