// Rigid bodies on one another on a soft plate: the load must be still.
#include "support/pile_cases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace ode::test {
namespace {

class Resting : public testing::TestWithParam<double> {};

void expect_still(const char* name, const PileRun& run, double h) {
    std::printf("%s, h %g ms: mean %.4f of %.4f N, ripple %.2e, gain %.1e J, %.2f s\n", name,
                1e3 * h, run.mean, run.weight, run.ripple / run.weight, run.gain, run.seconds);
    EXPECT_NEAR(run.mean / run.weight, 1, 1e-2);
    EXPECT_LT(run.ripple / run.weight, 1e-2);
    EXPECT_LT(run.gain, 0.01 * run.weight * 1e-3) << "1 % of the drop's energy";
}

TEST_P(Resting, BoxAlone) {
    expect_still("box", run_pile(Pile::box, GetParam(), 1e-3, 0.6), GetParam());
}
TEST_P(Resting, BoxOnPlate) {
    expect_still("box on plate", run_pile(Pile::stack, GetParam(), 1e-3, 0.6), GetParam());
}
TEST_P(Resting, ThreeBoxes) {
    expect_still("three", run_pile(Pile::three, GetParam(), 1e-3, 0.6), GetParam());
}
INSTANTIATE_TEST_SUITE_P(Step, Resting, testing::Values(1e-3, 5e-3, 16e-3));

} // namespace
} // namespace ode::test
