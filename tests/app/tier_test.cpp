// An application's say in how its bodies move.
#include "support/ringing_bar.h"
#include "support/soft_app.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace {

using namespace ode::soft;
using namespace ode::test;

struct Tier : testing::Test, RingingBar {
    Tier() : RingingBar(1e-7) { dSoftBodySetTier(body, "auto"); }
    std::string tier_after(int steps) {
        for (int i = 0; i < steps; ++i)
            step(1e-3);
        dSoftTierStatus status = {};
        status.struct_size = sizeof status;
        EXPECT_TRUE(dSoftBodyGetTierStatus(body, &status));
        return status.tier;
    }
};

TEST_F(Tier, KeepsTheWaveformTolerance) {
    EXPECT_EQ(dSoftBodyGetWaveformTolerance(body), 0.025);
    EXPECT_TRUE(dSoftBodySetWaveformTolerance(body, 0.001)); // no modes are as good as that
    EXPECT_EQ(tier_after(4), "explicit");
    EXPECT_TRUE(dSoftBodySetWaveformTolerance(body, 0.05));
    EXPECT_EQ(tier_after(6), "modal");
}

TEST_F(Tier, RefusesAToleranceThatIsNone) {
    Messages messages;
    for (const dReal bad : {0.0, -0.1, 1.5, std::nan("")})
        EXPECT_EQ(dSoftBodySetWaveformTolerance(body, bad), 0);
    EXPECT_EQ(Messages::with("waveform tolerance"), 4) << Messages::text();
    EXPECT_EQ(dSoftBodyGetWaveformTolerance(body), 0.025);
}

} // namespace
