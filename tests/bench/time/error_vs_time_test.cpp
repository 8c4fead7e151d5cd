// The yardsticks of the benchmark, on signals whose errors are known.
#include "bench/time/timed_run.h"
#include "bench/time/waveform_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ode::soft {
namespace {

TEST(ErrorVsTime, ReferenceHasNoErrorAndSilenceHasAll) {
    const TimeScene bar = time_scenes()[0];
    const Waveform reference = reference_of(bar);
    EXPECT_EQ(waveform_error(reference, reference), 0);
    Waveform silence = reference;
    for (auto& sample : silence)
        for (Vec3& v : sample)
            v.setZero();
    EXPECT_DOUBLE_EQ(waveform_error(silence, reference), 1);
    const RingingError error = ringing_error(bar, reference);
    EXPECT_LT(error.cents, 1e-3);
    EXPECT_LT(error.decay, 1e-3);
}

// A detuning by ten cents and a decay of twice its rate come out as such.
TEST(ErrorVsTime, DetuningAndDecayAreMeasured) {
    const TimeScene bar = time_scenes()[0];
    TimeScene other = bar;
    const double up = std::exp2(10.0 / 1200);
    for (double& f : other.modes.frequency)
        f *= up;
    for (double& d : other.decay)
        d *= 2 * up * up; // what is due to pitch is not counted as decay
    const RingingError error = ringing_error(bar, reference_of(other));
    EXPECT_NEAR(error.cents, 10, 1e-2);
    EXPECT_NEAR(error.decay, 1, 1e-2);
}

// What the table says of the library's default, and of methods with another claim each.
TEST(ErrorVsTime, DefaultRingsTrueAndImplicitOnesAsTheirTheorySays) {
    const TimeScene bar = time_scenes()[0];
    const Waveform reference = reference_of(bar);
    const auto ring = [&](const char* name, double share) {
        const TimedRun result = run(bar, {name, 2, share}, 60);
        EXPECT_TRUE(result.within_budget && result.stable) << name;
        return ringing_error(bar, result.waveform);
    };
    const RingingError ours = ring("central-difference", 0.9);
    EXPECT_LT(ours.cents, 17); // the elements', on a mesh for drafts
    EXPECT_LT(ours.decay, 0.01);
    const RingingError finer = ring("runge-kutta-4", 0.9);
    EXPECT_NEAR(ours.cents, finer.cents, 0.1) << "at such steps time is no source of error";
    EXPECT_GT(ring("linearised-backward-euler", 64).decay, 10) << "artificial damping";
}

} // namespace
} // namespace ode::soft
