#include "bridge/contact_sides.h"

#include <gtest/gtest.h>

namespace ode::sound {
namespace {

Vec3 along(double normal, const Vec3& across) {
    RigidTouch touch{};
    touch.normal = Vec3::UnitZ();
    touch.impulse = normal * Vec3::UnitZ() + across;
    return force_per_load(touch);
}

TEST(ContactSides, FrictionGoesWithTheLoad) {
    EXPECT_LT((along(2.0, {0.6, -0.8, 0}) - Vec3(0.3, -0.4, 1)).norm(), 1e-12);
    EXPECT_EQ(along(2.0, Vec3::Zero()), Vec3::UnitZ());
}

// A joint that bears next to nothing, or nothing, has been seen to rub with 1e17 times its load.
TEST(ContactSides, NoMoreFrictionThanLoadIsBelieved) {
    for (const double normal : {1.0, 1e-3, 1e-17, 1e-300, 0.0}) {
        const Vec3 force = along(normal, {3.0, 4.0, 0.0});
        ASSERT_TRUE(force.allFinite()) << normal;
        EXPECT_LT((force - Vec3(0.6, 0.8, 1)).norm(), 1e-12) << normal;
    }
}

} // namespace
} // namespace ode::sound
