// Jointed bodies against ODE stepped and re-collided wholly at the substep.
#include "support/coupling_cases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace ode::test {
namespace {

/// Impulse, energy and path within 0.1 % of the reference.
void expect_same(const CouplingCase& c, const CouplingRun& truth, double h) {
    const CouplingRun run = run_library(c, h);
    const double impulse = (run.impulse - truth.impulse).norm() / truth.impulse.norm();
    const double change = (run.energy_after - truth.energy_after) / truth.energy_before;
    double path = 0;
    ASSERT_EQ(run.path.size(), truth.path.size());
    for (std::size_t i = 0; i < run.path.size(); ++i)
        path = std::fmax(path, (run.path[i] - truth.path[i]).norm());
    std::printf("%s, h %g ms: J %.4f N s (%+.1e), F %.1f N (%+.1e), E %+.4f (%+.1e), path %.1e m "
                "of %.1e, %d steps apart; %.2f s, reference %.2f s\n",
                c.name.c_str(), 1e3 * h, run.impulse.norm(), impulse, run.peak,
                run.peak / truth.peak - 1, run.energy_after / run.energy_before - 1, change, path,
                truth.length, run.steps_apart, run.seconds, truth.seconds);
    EXPECT_GT(truth.impulse.norm(), 1e-3) << "the bodies must have met";
    EXPECT_LT(impulse, 1e-3);
    EXPECT_LT(std::fabs(change), 1e-3);
    EXPECT_LT(path, 1e-3 * truth.length);
    EXPECT_GT(run.mirror_steps, 0U);
}

class Jointed : public testing::TestWithParam<int> {};

TEST_P(Jointed, MovesAsUnderOdeAtTheSubstep) {
    const CouplingCase c = coupling_cases()[static_cast<std::size_t>(GetParam())];
    const CouplingRun truth = run_reference(c);
    for (const double h : {1e-3, 5e-3, 16e-3})
        expect_same(c, truth, h == 5e-3 ? 16e-3 / 3 : h);
}
INSTANTIATE_TEST_SUITE_P(Cases, Jointed, testing::Range(0, 3));

class MassRatio : public testing::TestWithParam<double> {};

TEST_P(MassRatio, MovesAsUnderOdeAtTheSubstep) {
    const CouplingCase c = mass_ratio_case(GetParam());
    const CouplingRun truth = run_reference(c);
    for (const double h : {1e-3, 16e-3})
        expect_same(c, truth, h);
}
INSTANTIATE_TEST_SUITE_P(SoftToRigid, MassRatio, testing::Values(1e-2, 1e-1, 1, 1e1, 1e2));

} // namespace
} // namespace ode::test
