#include "couple/node_contact.h"

#include <gtest/gtest.h>
#include <ode/ode.h>

#include <cmath>
#include <random>

namespace ode::soft {
namespace {

/// Unconnected surface nodes of equal mass and area: the contact law without elasticity.
class Particles {
public:
    Particles(std::size_t count, double mass) : position(count), velocity(count), force(count) {
        for (std::size_t i = 0; i < count; ++i) {
            surface.node.push_back(static_cast<int>(i));
            surface.area.push_back(1e-4);
            surface.mass.push_back(mass);
        }
        surface.mean_edge = 0.01;
        surface.mass_per_area = mass / 1e-4;
        inverse_mass.assign(count, 1 / mass);
    }

    /// @param gravity [m/s^2]
    void advance(double dt, const Vec3& gravity) {
        for (std::size_t i = 0; i < position.size(); ++i) {
            velocity[i] += dt * (inverse_mass[i] * force[i] + gravity);
            position[i] += dt * velocity[i];
        }
        force.set_zero();
    }

    Vec3 momentum() const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < position.size(); ++i)
            sum += surface.mass[i] * velocity[i];
        return sum;
    }
    Vec3 angular_momentum() const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < position.size(); ++i)
            sum += surface.mass[i] * position[i].cross(velocity[i]);
        return sum;
    }
    double energy() const {
        double sum = 0;
        for (std::size_t i = 0; i < position.size(); ++i)
            sum += surface.mass[i] * velocity[i].squaredNorm() / 2;
        return sum;
    }

    SurfaceNodes surface;
    std::vector<double> inverse_mass;
    NodeArray position;
    NodeArray velocity;
    NodeArray force;
};

RigidShape plane(const Vec3& normal = Vec3::UnitZ()) {
    RigidShape shape;
    shape.pose.rotation = Quat::FromTwoVectors(Vec3::UnitZ(), normal).toRotationMatrix();
    return shape;
}

constexpr dGeomID kNoGeom = nullptr;

// A node thrown onto a floor without friction or damping comes back as fast as it came, wherever
// between two substeps it entered and left.
TEST(NodeContact, ReturnsANodeFromAFloor) {
    const double dt = 1e-5;
    Particles p(1, 1e-3);
    p.position[0] = Vec3(0, 0, 1e-4);
    p.velocity[0] = Vec3(0.3, 0, -1);
    RigidShadow ground;
    NodeContact contact(p.surface, kNoGeom);
    ContactLaw law;
    law.friction = 0;
    law.damping = 0;
    law.stiffness = 1e9; // k dt^2 / m = 0.01
    contact.begin_step(plane(), law, p.inverse_mass, dt);
    int bearing = 0;
    for (int i = 0; i < 100; ++i) {
        bearing += static_cast<int>(
            contact.add_force(p.position, p.velocity, ground, dt, p.force).bearing);
        p.advance(dt, Vec3::Zero());
    }
    // Half a period of the spring, and the substeps that lead in and out.
    EXPECT_NEAR(bearing, M_PI / std::sqrt(0.01) + 1, 1.5);
    EXPECT_NEAR(p.velocity[0].z(), 1, 1e-12);
    EXPECT_EQ(p.velocity[0].x(), 0.3);
}

// Cloud against each shape, both free, with friction and damping: what one gives the other takes.
TEST(NodeContact, KeepsMomentaOfThePairToRounding) {
    dInitODE2(0);
    const dWorldID world = dWorldCreate();
    for (const ShapeKind kind :
         {ShapeKind::sphere, ShapeKind::box, ShapeKind::capsule, ShapeKind::cylinder}) {
        const dBodyID body = dBodyCreate(world);
        dMass mass;
        dMassSetParameters(&mass, 0.05, 0, 0, 0, 2e-5, 3e-5, 4e-5, 0, 0, 0);
        dBodySetMass(body, &mass);
        dBodySetAngularVel(body, 10, -5, 20);
        dBodySetLinearVel(body, 0, 0, -2);
        RigidShape shape;
        shape.kind = kind;
        shape.size = Vec3(0.03, 0.04, 0.02);
        shape.body = body;

        const double dt = 1e-5;
        const int steps = 2000;
        Particles p(200, 1e-3);
        std::mt19937 random(5);
        std::uniform_real_distribution<double> coordinate(-0.06, 0.06);
        for (std::size_t i = 0; i < 200; ++i)
            p.position[i] = Vec3(coordinate(random), coordinate(random), -0.06);
        RigidShadow shadow(body, steps * dt, dt);
        NodeContact contact(p.surface, kNoGeom);
        contact.begin_step(shape, ContactLaw{}, p.inverse_mass, dt);
        const auto total = [&] {
            const RigidMotion& m = shadow.motion();
            const Mat3& r = m.pose.rotation;
            const Vec3 spin =
                r * Vec3(Vec3(2e-5, 3e-5, 4e-5).asDiagonal() * (r.transpose() * m.spin));
            const Vec3 linear = p.momentum() + 0.05 * m.velocity;
            const Vec3 angular =
                p.angular_momentum() + spin + 0.05 * m.pose.position.cross(m.velocity);
            return std::pair(linear, angular);
        };
        const auto before = total();
        double hardest = 0;
        for (int i = 0; i < steps; ++i) {
            contact.add_force(p.position, p.velocity, shadow, dt, p.force);
            shadow.advance(dt);
            p.advance(dt, Vec3::Zero());
            hardest = std::fmax(hardest, shadow.impulse().force.norm());
        }
        const auto after = total();
        ASSERT_GT(hardest, 0.01) << static_cast<int>(kind); // they did meet
        // 2000 substeps of up to 200 rounded sums of quantities up to 0.1: 1e-15 each at worst
        EXPECT_LT((after.first - before.first).norm(), 1e-14) << static_cast<int>(kind);
        EXPECT_LT((after.second - before.second).norm(), 1e-15) << static_cast<int>(kind);
        dBodyDestroy(body);
    }
    dWorldDestroy(world);
    dCloseODE();
}

class Slope : public testing::Test {
protected:
    /// Slides a node for `seconds` down a slope of the given tangent, mu = 0.5, settled first.
    /// @return displacement down the slope [m] and speed [m/s].
    std::pair<double, double> slide(double tangent, double seconds) {
        const double dt = 1e-5;
        const double angle = std::atan(tangent);
        const Vec3 down(std::cos(angle), 0, -std::sin(angle));
        const Vec3 normal(std::sin(angle), 0, std::cos(angle));
        Particles p(4, 1e-3);
        RigidShadow ground;
        NodeContact contact(p.surface, kNoGeom);
        ContactLaw law;
        law.stiffness = 1e9;
        contact.begin_step(plane(normal), law, p.inverse_mass, dt);
        const double depth = 1e-3 * 9.81 * std::cos(angle) / (law.stiffness * 1e-4);
        for (std::size_t i = 0; i < 4; ++i)
            p.position[i] = -depth * normal + 0.1 * static_cast<double>(i) * Vec3::UnitY();
        const auto steps = std::lround(seconds / dt);
        for (long i = 0; i < steps; ++i) {
            if (i % 1000 == 0) // an ODE step: anchors outlive it
                contact.begin_step(plane(normal), law, p.inverse_mass, dt);
            contact.add_force(p.position, p.velocity, ground, dt, p.force);
            p.advance(dt, Vec3(0, 0, -9.81));
        }
        return {p.position[3].dot(down), p.velocity[3].dot(down)};
    }
};

TEST_F(Slope, HoldsBelowTheFrictionAngle) {
    const auto [before, v0] = slide(0.4, 0.5);
    const auto [after, v1] = slide(0.4, 1.0);
    EXPECT_LT(std::fabs(v1), 1e-12);
    EXPECT_LT(std::fabs(after - before), 1e-13); // no creep at all
}

// Two hundredths beside the limit of 0.5.
TEST_F(Slope, TellsHoldingFromSlidingNearTheLimit) {
    const auto [before, v0] = slide(0.49, 0.5);
    const auto [after, v1] = slide(0.49, 1.0);
    EXPECT_LT(std::fabs(v1), 1e-12);
    EXPECT_LT(std::fabs(after - before), 1e-13);
    EXPECT_LT(before, 1e-5);
    const double angle = std::atan(0.51);
    // Between two moments: while the spring is first stretched, the node slides more freely.
    const double gain = 9.81 * (std::sin(angle) - 0.5 * std::cos(angle)) * 0.5;
    EXPECT_NEAR(slide(0.51, 1.0).second - slide(0.51, 0.5).second, gain, 1e-3 * gain);
}

TEST_F(Slope, SlidesAboveItAsCoulombSays) {
    const double seconds = 0.5;
    const double angle = std::atan(0.6);
    const double speed = 9.81 * (std::sin(angle) - 0.5 * std::cos(angle)) * seconds;
    // The spring has to be stretched first: by mu F / k_t = 7e-8 m, 0.1 ms of sliding.
    EXPECT_NEAR(slide(0.6, seconds).second, speed, 1e-3 * speed);
}

TEST_F(Slope, StopsWithoutBeingPushedBack) {
    const double dt = 1e-5;
    Particles p(1, 1e-3);
    RigidShadow ground;
    NodeContact contact(p.surface, kNoGeom);
    ContactLaw law;
    law.stiffness = 1e9;
    contact.begin_step(plane(), law, p.inverse_mass, dt);
    p.position[0] = Vec3(0, 0, -1e-3 * 9.81 / 1e5);
    p.velocity[0] = Vec3(0.1, 0, 0);
    double least = 0;
    for (int i = 0; i < 10000; ++i) {
        contact.add_force(p.position, p.velocity, ground, dt, p.force);
        p.advance(dt, Vec3(0, 0, -9.81));
        least = std::fmin(least, p.velocity[0].x());
    }
    EXPECT_NEAR(p.position[0].x(), 0.1 * 0.1 / (2 * 0.5 * 9.81), 1e-5); // v^2 / (2 mu g)
    EXPECT_NEAR(p.velocity[0].x(), 0, 1e-12);
    // The spring was stretched by mu F / k_t and gives that energy back: v = mu F / sqrt(k_t m).
    EXPECT_GT(least, -0.5 * 9.81e-3 / std::sqrt(0.7 * 1e5 * 1e-3));
}

// A rigid body a thousand times lighter than the nodes it lies between, and as much heavier: its
// bound on explicit stability is another one, and the contact finds it.
TEST(NodeContact, StaysStableForAnyMassRatio) {
    dInitODE2(0);
    const dWorldID world = dWorldCreate();
    for (const double ratio : {1e-3, 1e-2, 1e-1, 1.0, 1e1, 1e2, 1e3}) {
        const dBodyID body = dBodyCreate(world);
        Particles p(100, 1e-3);
        dMass mass;
        dMassSetBoxTotal(&mass, ratio * 0.1, 0.1, 0.1, 0.02);
        dBodySetMass(body, &mass);
        dBodySetPosition(body, 0, 0, 0.011);
        dBodySetLinearVel(body, 0.1, 0, -1);
        RigidShape shape;
        shape.kind = ShapeKind::box;
        shape.size = Vec3(0.05, 0.05, 0.01);
        shape.body = body;
        const double dt = 1e-5;
        for (std::size_t i = 0; i < 100; ++i)
            p.position[i] = Vec3(0.009 * static_cast<double>(i % 10) - 0.04,
                                 0.009 * static_cast<double>(i / 10) - 0.04, 0);
        RigidShadow shadow(body, 0.05, dt);
        NodeContact contact(p.surface, kNoGeom);
        ContactLaw law; // as stiff as the substep allows
        contact.begin_step(shape, law, p.inverse_mass, dt);
        const auto energy = [&] {
            const RigidMotion& m = shadow.motion();
            const Vec3 w = m.pose.rotation.transpose() * m.spin;
            return p.energy() + ratio * 0.05 * m.velocity.squaredNorm() +
                   0.5 * w.dot(Vec3(mass.I[0], mass.I[5], mass.I[10]).asDiagonal() * w);
        };
        const double start = energy();
        double most = 0;
        for (int i = 0; i < 5000; ++i) {
            contact.add_force(p.position, p.velocity, shadow, dt, p.force);
            shadow.advance(dt);
            p.advance(dt, Vec3::Zero());
            most = std::fmax(most, energy());
        }
        EXPECT_LT(most, 1.01 * start) << ratio;
        EXPECT_GT(shadow.motion().velocity.z(), -1) << ratio;
        dBodyDestroy(body);
    }
    dWorldDestroy(world);
    dCloseODE();
}

TEST(NodeContact, TestsOnlyNodesThatMayTouch) {
    Particles p(1000, 1e-3);
    for (std::size_t i = 0; i < 1000; ++i)
        p.position[i] = Vec3(0, 0, 1 + 0.01 * static_cast<double>(i));
    RigidShadow ground;
    NodeContact contact(p.surface, kNoGeom);
    contact.begin_step(plane(), ContactLaw{}, p.inverse_mass, 1e-5);
    unsigned long tests = 0;
    for (int i = 0; i < 1000; ++i)
        tests += contact.add_force(p.position, p.velocity, ground, 1e-5, p.force).tests;
    EXPECT_EQ(tests, 1000u); // one look; the floor is a metre away
}

} // namespace
} // namespace ode::soft
