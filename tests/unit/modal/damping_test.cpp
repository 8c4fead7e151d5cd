#include "model/damping.h"

#include "base/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ode::soft {
namespace {

TEST(Damping, T60IsWhenTheAmplitudeHasFallenByAThousand) {
    const RayleighDamping rayleigh{.alpha = 3, .beta = 2e-7};
    for (const double f : {100.0, 1000.0, 8000.0}) {
        const double d = rayleigh.decay(f), t60 = t60_of_decay(d);
        const double w = 2 * std::numbers::pi * f;
        EXPECT_NEAR(2 * d, 3 + 2e-7 * w * w, 1e-9 * d);
        EXPECT_NEAR(std::exp(-d * t60), 1e-3, 1e-15);
        EXPECT_NEAR(t60, 6.908 / d, 3e-4 / d); // 6.908 is ln(1000) = 6.90776 rounded
    }
}

// Energy lost in a radian over energy stored, and half-power bandwidth, define eta and Q.
TEST(Damping, LossFactorIsEnergyLostPerRadian) {
    const double f = 440, d = 5;
    const double lost_per_cycle = 1 - std::exp(-2 * d / f);
    EXPECT_NEAR(loss_factor_of_decay(d, f), lost_per_cycle / (2 * std::numbers::pi),
                0.02 * loss_factor_of_decay(d, f)); // to the first order in d/f
    EXPECT_NEAR(loss_factor_of_decay(d, f) * quality_of_decay(d, f), 1, 1e-14);
}

TEST(Damping, ConversionsGoThereAndBack) {
    for (const double d : {0.1, 7.0, 300.0}) {
        EXPECT_NEAR(decay_of_t60(t60_of_decay(d)), d, 1e-13 * d);
        EXPECT_NEAR(decay_of_quality(quality_of_decay(d, 523.0), 523.0), d, 1e-13 * d);
        EXPECT_NEAR(decay_of_loss_factor(loss_factor_of_decay(d, 523.0), 523.0), d, 1e-13 * d);
    }
    EXPECT_EQ(t60_of_decay(0), HUGE_VAL);
}

TEST(Damping, RayleighGoesThroughTwoDecayTimes) {
    const RayleighDamping r = rayleigh_through(200, 2.0, 4000, 0.3);
    EXPECT_NEAR(t60_of_decay(r.decay(200)), 2.0, 1e-12);
    EXPECT_NEAR(t60_of_decay(r.decay(4000)), 0.3, 1e-12);
    const auto refused = [](double f1, double t1, double f2, double t2) {
        EXPECT_THROW(rayleigh_through(f1, t1, f2, t2), InputError);
    };
    refused(200, 1.0, 4000, 2.0); // grows with frequency
    refused(200, 1.0, 400, 0.1);  // falls faster than 1/f^2
    refused(200, 1.0, 200, 0.5);  // at one frequency
    refused(200, 0.0, 4000, 0.3);
}

TEST(Damping, EachLawGivesEachModeItsDecay) {
    const std::vector<double> f{100, 200, 400};
    Damping damping;
    damping.rayleigh = {.alpha = 2, .beta = 1e-6};
    EXPECT_NEAR(damping.decays(f)[2], 1 + 0.5e-6 * std::pow(800 * std::numbers::pi, 2), 1e-12);
    damping.law = Damping::Law::kLossFactor;
    damping.loss_factor = 0.01;
    EXPECT_NEAR(damping.decays(f)[1], std::numbers::pi * 2, 1e-12);
    damping.law = Damping::Law::kTable;
    damping.t60 = {3, 1.5};
    const auto d = damping.decays(f);
    EXPECT_NEAR(t60_of_decay(d[0]), 3, 1e-12);
    EXPECT_NEAR(t60_of_decay(d[1]), 1.5, 1e-12);
    EXPECT_EQ(d[2], d[1]);
    damping.t60 = {HUGE_VAL};
    EXPECT_EQ(damping.decays(f)[0], 0);
}

TEST(Damping, RefusesNonsense) {
    const std::vector<double> f{100};
    Damping damping;
    damping.rayleigh.alpha = -1;
    EXPECT_THAT([&] { damping.decays(f); },
                testing::ThrowsMessage<InputError>(testing::HasSubstr("alpha [1/s] is -1")));
    damping.law = Damping::Law::kLossFactor;
    damping.loss_factor = std::nan("");
    EXPECT_THROW(damping.decays(f), InputError);
    damping.law = Damping::Law::kTable;
    EXPECT_THROW(damping.decays(f), InputError);
    damping.t60 = {1, 0};
    EXPECT_THAT([&] { damping.decays(f); },
                testing::ThrowsMessage<InputError>(testing::HasSubstr("T60 of mode 1 is 0 s")));
}

} // namespace
} // namespace ode::soft
