// A bowl in modes that lies on its rim: it comes to rest, and may sleep.
#include "physics/tier/tier_run.h"

#include <gtest/gtest.h>

#include <numbers>

namespace ode::soft {
namespace {

constexpr double kGravity = 9.81;

/// A little aslant, just over a floor.
void lay_down(TierRun& run) {
    Body& body = run.body();
    dCreatePlane(run.space(), 0, 0, 1, 0);
    const Vec3 axis = Vec3(1, 0.2, 0).normalized();
    body.rotate(Quat(Eigen::AngleAxisd(std::numbers::pi - 0.003, axis)));
    double low = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < body.mass().size(); ++i)
        low = std::min(low, body.state().position[i].z());
    body.move_to(body.center_of_mass() + Vec3(0, 0, 1e-5 - low));
}

// Taken always in one order, its nodes would drive it: at 5e-5 J for ever, 50 dB of sound. At rest
// a substep's share of its weight is left of its speed, and what gravity bends.
TEST(RestInModes, DiesAway) {
    TierRun run(TierChoice::modes, 1, -kGravity);
    lay_down(run);
    for (int i = 0; i < 500; ++i)
        run.step(1e-3);
    ASSERT_TRUE(run.body().rings());
    const double substep = 1e-3 / 64; // at most
    const double left = run.body().total_mass() * std::pow(kGravity * substep, 2) / 2;
    EXPECT_LT(run.body().modal_motion()->rigid_energy(), left);
    EXPECT_LT(run.body().modal_motion()->vibration_energy(), 2e-7);
}

TEST(RestInModes, FallsAsleep) {
    TierRun run(TierChoice::modes, 1, -kGravity);
    run.body().set_auto_disable(true);
    lay_down(run);
    for (int i = 0; i < 1000 && !run.body().asleep(); ++i)
        run.step(1e-3);
    EXPECT_TRUE(run.body().asleep());
}

} // namespace
} // namespace ode::soft
