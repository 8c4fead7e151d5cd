#include "couple/rigid_response.h"

#include <gtest/gtest.h>
#include <ode/ode.h>

#include <cmath>
#include <vector>

namespace ode::soft {
namespace {

constexpr double kDt = 1e-5;

/// A rigid body between springs whose other ends are fixed: its normal contacts alone.
class Bed : public testing::TestWithParam<double> {
protected:
    Bed() {
        dInitODE2(0);
        world_ = dWorldCreate();
        const dBodyID body = dBodyCreate(world_);
        dMass mass;
        dMassSetBoxTotal(&mass, GetParam(), 0.1, 0.08, 0.01);
        dBodySetMass(body, &mass);
        dBodySetPosition(body, 0, 0, 1e-5);
        dBodySetLinearVel(body, 0.1, 0, -1);
        dBodySetAngularVel(body, 3, -2, 1);
        shadow_ = RigidShadow(body, 0.01, kDt);
        mass_ = mass;
        for (int i = -2; i <= 2; ++i)
            for (int k = -2; k <= 2; ++k)
                foot_.push_back(Vec3(0.02 * i, 0.016 * k, 0));
    }
    ~Bed() override {
        dWorldDestroy(world_);
        dCloseODE();
    }
    double kinetic() const {
        const RigidMotion& m = shadow_.motion();
        const Vec3 w = m.pose.rotation.transpose() * m.spin;
        return mass_.mass * m.velocity.squaredNorm() / 2 +
               w.dot(Vec3(mass_.I[0], mass_.I[5], mass_.I[10]).asDiagonal() * w) / 2;
    }
    /// @return sweeps that it took.
    int substep() {
        std::vector<double> press(foot_.size());
        response_.begin(shadow_, kDt);
        int sweeps = 0;
        settle([&] {
            ++sweeps;
            response_.open(shadow_);
            for (std::size_t i = 0; i < foot_.size(); ++i) {
                const Vec3 x = shadow_.motion().pose.to_world(foot_[i]);
                const Press p = NormalContact{.stiffness = kStiffness,
                                              .damping = 0,
                                              .compliance = 0,
                                              .depth = -x.z(),
                                              .speed = -shadow_.motion().velocity_at(x).z(),
                                              .ahead = -response_.velocity_at(x).z()}
                                    .press(kDt);
                response_.add(x, Vec3::UnitZ(), p, press[i]);
                press[i] = p.force;
            }
            response_.close(shadow_);
            return response_.change();
        });
        shadow_.advance(kDt);
        return sweeps;
    }

    static constexpr double kStiffness = 1e6;
    dWorldID world_;
    dMass mass_;
    RigidShadow shadow_;
    RigidResponse response_;
    std::vector<Vec3> foot_;
};

// 25 springs; k dt^2 / m in all from 2.5e-3 to 2500: an explicit step bears 4.
TEST_P(Bed, ReturnsABodyAsFastAsItCame) {
    const double before = kinetic();
    int most = 0;
    double highest = 0;
    for (int i = 0; i < 1000; ++i) {
        most = std::max(most, substep());
        highest = std::fmax(highest, kinetic());
    }
    EXPECT_GT(shadow_.motion().velocity.z(), 0);
    EXPECT_NEAR(kinetic(), before, 5e-3 * before);
    EXPECT_LT(highest, before * (1 + 5e-3));
    EXPECT_LE(most, 8);
    EXPECT_NEAR(shadow_.motion().velocity.x(), 0.1, 1e-15); // nothing pushes sideways
}

INSTANTIATE_TEST_SUITE_P(Mass, Bed, testing::Values(1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6));

TEST(RigidResponse, LeavesWhatCannotMoveAlone) {
    RigidShadow ground;
    RigidResponse response;
    response.begin(ground, kDt);
    EXPECT_FALSE(response.moves());
    response.open(ground);
    response.add(Vec3::UnitX(), Vec3::UnitZ(), {3, 3, 1e3}, 0);
    response.close(ground);
    EXPECT_EQ(response.change(), 1);
    EXPECT_EQ(response.velocity_at(Vec3::UnitX()).norm(), 0);
}

} // namespace
} // namespace ode::soft
