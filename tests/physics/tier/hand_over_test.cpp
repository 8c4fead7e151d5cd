// A body that changes between modes and nodes keeps its motion.
#include "tier_run.h"

#include <gtest/gtest.h>

namespace ode::soft {
namespace {

double energy(const Body& body) { return body.kinetic_energy() + body.elastic_energy(); }

/// Ringing, flying and spinning.
void set_off(TierRun& run) {
    run.body().set_velocity({0.3, -0.2, 0.5});
    run.body().add_spin({8, -5, 20});
    for (int i = 0; i < 30; ++i) {
        run.body().add_force(3, {20, -50, 100});
        run.step(1e-5);
    }
    for (int i = 0; i < 100; ++i)
        run.step(1e-5);
}

class HandOverFrom : public testing::TestWithParam<TierChoice> {};

TEST_P(HandOverFrom, ModesToNodesKeepsMomentumAndEnergy) {
    TierRun run(GetParam());
    set_off(run);
    Body& body = run.body();
    ASSERT_TRUE(body.rings());
    const Vec3 linear = body.linear_momentum(), angular = body.angular_momentum();
    const double before = energy(body);
    const NodeState state = body.state();
    body.set_tier(TierChoice::explicit_space);
    ASSERT_FALSE(body.rings());
    EXPECT_LT((body.linear_momentum() - linear).norm(), 1e-12 * linear.norm());
    EXPECT_LT((body.angular_momentum() - angular).norm(), 1e-12 * angular.norm());
    EXPECT_EQ(energy(body), before);
    for (std::size_t i = 0; i < body.mass().size(); ++i)
        ASSERT_EQ(Vec3(body.state().position[i]), Vec3(state.position[i]));
    // Nothing clicks: a step on, the energy is still the same.
    run.step(1e-5);
    EXPECT_NEAR(energy(body), before, 1e-3 * before);
    EXPECT_LT((body.linear_momentum() - linear).norm(), 1e-10 * linear.norm());
}

TEST_P(HandOverFrom, ModesToNodesAndBackKeepsModesAndMomentum) {
    TierRun run(GetParam());
    set_off(run);
    Body& body = run.body();
    ASSERT_EQ(body.bends(), GetParam() == TierChoice::cubic);
    const ModalState before = body.modal_motion()->state();
    const double vibration = body.modal_motion()->vibration_energy();
    ModalMotion again(body.modal_motion()->shared_basis());
    if (body.bends()) {
        again.set_cubic(body.modal_motion()->cubic()->shared_terms());
        again.use_cubic(true);
    }
    again.take(body.state(), {});
    double off = 0;
    for (std::size_t k = 0; k < before.rate.size(); ++k)
        off += std::pow(again.state().rate[k] - before.rate[k], 2);
    EXPECT_LT(std::sqrt(off), 1e-4 * std::sqrt(2 * vibration));
    EXPECT_LT((again.state().spin_momentum - before.spin_momentum).norm(),
              1e-10 * before.spin_momentum.norm());
    EXPECT_LT((again.state().velocity - before.velocity).norm(), 1e-12);
    EXPECT_LT((again.state().center - before.center).norm(), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Tiers, HandOverFrom,
                         testing::Values(TierChoice::modes, TierChoice::cubic));

// From linear modes to what isn't linear of them and back: amplitudes stay, to the bit.
TEST(HandOver, BetweenModalTiersKeepsAmplitudes) {
    TierRun run(TierChoice::modes);
    set_off(run);
    Body& body = run.body();
    const ModalState before = body.modal_motion()->state();
    ModalMotion motion = *body.modal_motion();
    run.body().set_tier(TierChoice::cubic);
    run.step(1e-5); // finds the terms
    ASSERT_TRUE(body.bends());
    motion.set_cubic(body.modal_motion()->cubic()->shared_terms());
    for (const bool on : {true, false}) {
        motion.use_cubic(on);
        EXPECT_EQ(motion.state().amplitude, before.amplitude);
        EXPECT_EQ(motion.state().rate, before.rate);
        EXPECT_EQ(motion.state().spin_momentum, before.spin_momentum);
    }
}

// An app may ask for either at any moment.
TEST(HandOver, AutomaticTierRingsInModesOnceTheBlowIsOver) {
    TierRun run(TierChoice::automatic);
    set_off(run);
    for (int i = 0; i < 30 && !run.body().rings(); ++i)
        run.step(1e-3);
    EXPECT_TRUE(run.body().rings());
    EXPECT_LT(run.body().linear_error(), 0.025);
}

TEST(HandOver, AStrongBlowIsExplicit) {
    TierRun run(TierChoice::automatic);
    for (int i = 0; i < 30; ++i) {
        run.body().add_force(3, {0, 0, 1e6});
        run.step(1e-5);
    }
    run.step(1e-4);
    EXPECT_FALSE(run.body().rings());
    EXPECT_GT(run.body().linear_error(), 0.025);
}

TEST(HandOver, LikeBodiesShareTheirModes) {
    TierRun run(TierChoice::modes);
    Body& twin = run.world().create_body(run.body().mesh(), run.body().solids());
    twin.set_tier(TierChoice::modes);
    twin.move_to({1, 0, 0});
    run.step(1e-3);
    ASSERT_TRUE(twin.rings());
    EXPECT_EQ(twin.modal_motion()->shared_basis(), run.body().modal_motion()->shared_basis());
}

} // namespace
} // namespace ode::soft
