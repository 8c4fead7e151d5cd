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

TEST(DampingTable, GoesThroughItsEntriesByPowersAndStaysBeyondThem) {
    const DampingTable table(std::vector{100.0, 400.0, 1000.0}, std::vector{4.0, 1.0, 2.0});
    EXPECT_NEAR(t60_of_decay(table.decay(100)), 4, 1e-12);
    EXPECT_NEAR(t60_of_decay(table.decay(400)), 1, 1e-12);
    EXPECT_NEAR(t60_of_decay(table.decay(1000)), 2, 1e-12);
    EXPECT_NEAR(t60_of_decay(table.decay(50)), 4, 1e-12);
    EXPECT_NEAR(t60_of_decay(table.decay(9e9)), 2, 1e-12);
    // T60 ~ 1/f from 100 to 400 Hz: a loss factor, at all frequencies between.
    const double eta = loss_factor_of_decay(table.decay(100), 100);
    for (const double f : {150.0, 200.0, 390.0})
        EXPECT_NEAR(loss_factor_of_decay(table.decay(f), f), eta, 1e-13);
    EXPECT_TRUE(DampingTable().empty());
}

TEST(DampingTable, RefusesNonsenseByEntry) {
    const auto refusal = [](std::vector<double> f, std::vector<double> t60) -> std::string {
        try {
            DampingTable(f, t60);
        } catch (const InputError& e) {
            return e.what();
        }
        return "";
    };
    using testing::HasSubstr;
    EXPECT_THAT(refusal({100, 200}, {1, 0}), HasSubstr("entry 1 of the damping table is T60 0 s"));
    EXPECT_THAT(refusal({100, 200}, {1, HUGE_VAL}), HasSubstr("positive and finite"));
    EXPECT_THAT(refusal({-1}, {1}), HasSubstr("at -1 Hz"));
    EXPECT_THAT(refusal({std::nan("")}, {1}), HasSubstr("entry 0"));
    EXPECT_THAT(refusal({200, 200}, {1, 1}), HasSubstr("200 Hz, doesn't lie above"));
}

} // namespace
} // namespace ode::soft
