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
    dSoftTierStatus status_after(int steps) {
        for (int i = 0; i < steps; ++i)
            step(1e-3);
        dSoftTierStatus status = {};
        status.struct_size = sizeof status;
        EXPECT_TRUE(dSoftBodyGetTierStatus(body, &status));
        return status;
    }
    std::string tier_after(int steps) { return status_after(steps).tier; }
};

TEST_F(Tier, KeepsTheWaveformTolerance) {
    EXPECT_EQ(dSoftBodyGetWaveformTolerance(body), 0.025);
    EXPECT_TRUE(dSoftBodySetWaveformTolerance(body, 0.001)); // no modes are as good as that
    EXPECT_EQ(tier_after(4), "explicit");
    EXPECT_TRUE(dSoftBodySetWaveformTolerance(body, 0.05));
    EXPECT_EQ(tier_after(6), "modal");
}

TEST_F(Tier, TellsWhatItCosts) {
    dSoftBodySetTier(body, "explicit");
    const dReal nodes = status_after(2).cost;
    dSoftStatus body_status = {};
    body_status.struct_size = sizeof body_status;
    ASSERT_TRUE(dSoftBodyGetStatus(body, &body_status));
    EXPECT_NEAR(nodes, 60 * 1e-8 / body_status.substep, 0.01 * nodes); // elements, 10 ns each
    dSoftBodySetTier(body, "modal");
    const dSoftTierStatus modal = status_after(2);
    EXPECT_STREQ(modal.tier, "modal");
    EXPECT_GT(modal.cost, 0);
    EXPECT_LT(modal.cost, nodes / 100);
    dSoftBodyDisable(body);
    const dSoftTierStatus asleep = status_after(1);
    EXPECT_STREQ(asleep.tier, "asleep");
    EXPECT_EQ(asleep.cost, 0);
}

TEST_F(Tier, MayBeCubic) {
    EXPECT_TRUE(dSoftBodySetTier(body, "cubic"));
    EXPECT_STREQ(dSoftBodyGetTier(body), "cubic");
    EXPECT_EQ(tier_after(2), "cubic");
    dSoftModalBasis basis = {};
    basis.struct_size = sizeof basis;
    ASSERT_TRUE(dSoftBodyGetModalBasis(body, &basis));
    for (int k = 1; k < basis.mode_count; ++k)
        EXPECT_LE(basis.omega[k - 1], basis.omega[k]);
    dSoftTierStatus status = {};
    status.struct_size = sizeof status;
    ASSERT_TRUE(dSoftBodyGetTierStatus(body, &status));
    EXPECT_GT(status.kept, 0);
}

// A steel die rings far above hearing.
TEST(TierOfADie, IsExplicitAndSaysWhy) {
    for (const char* tier : {"modal", "cubic"}) {
        const Messages messages;
        OdeApp app;
        const WorldHandle world(dSoftWorldCreate(app.world, app.space));
        const MeshHandle mesh(dSoftMeshCreateBox(0.01, 0.01, 0.01, 2, 2, 2));
        const dSoftSolid steel = dSoftSolidDefault();
        const dSoftBodyID body = dSoftBodyCreate(world, mesh, &steel);
        ASSERT_TRUE(dSoftBodySetTier(body, tier));
        app.step(1e-4);
        EXPECT_EQ(Messages::with("no vibration mode below 22 kHz"), 1) << Messages::text();
        dSoftTierStatus status = {};
        status.struct_size = sizeof status;
        ASSERT_TRUE(dSoftBodyGetTierStatus(body, &status));
        EXPECT_STREQ(status.tier, "explicit");
    }
}

TEST_F(Tier, RefusesAToleranceThatIsNone) {
    Messages messages;
    for (const dReal bad : {0.0, -0.1, 1.5, std::nan("")})
        EXPECT_EQ(dSoftBodySetWaveformTolerance(body, bad), 0);
    EXPECT_EQ(Messages::with("waveform tolerance"), 4) << Messages::text();
    EXPECT_EQ(dSoftBodyGetWaveformTolerance(body), 0.025);
}

} // namespace
