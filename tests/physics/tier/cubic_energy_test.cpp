// The cubic tier without damping keeps its energy: no drift over ten thousand intervals, at bends
// that auto would leave it at.
#include "tier_run.h"

#include <gtest/gtest.h>

namespace ode::soft {
namespace {

TEST(CubicEnergy, DoesNotDrift) {
    TierRun run(TierChoice::cubic);
    run.step(1e-5);
    ASSERT_TRUE(run.body().bends());
    const ModalMotion& of = *run.body().modal_motion();
    auto basis = std::make_shared<ModalBasis>(of.basis());
    std::fill(basis->decay.begin(), basis->decay.end(), 0.0);
    ModalMotion motion(basis);
    motion.set_cubic(of.cubic()->shared_terms());
    motion.use_cubic(true);
    NodeState state = run.body().state();
    const auto size = static_cast<double>(basis->reach[0]);
    for (std::size_t n = 0; n < basis->nodes(); ++n)
        for (std::size_t k = 0; k < 12; ++k) // a tenth of the thickness
            for (std::size_t axis = 0; axis < 3; ++axis)
                state.position[n][static_cast<int>(axis)] +=
                    2e-4 / (1.0 + static_cast<double>(k)) / size *
                    static_cast<double>(basis->row(n, axis)[k]);
    motion.take(state, {});
    const double dt = motion.cubic()->longest();
    double first = 0, last = 0, least = HUGE_VAL, most = 0;
    const std::size_t entries = motion.cubic()->entries();
    constexpr int kIntervals = 10000, kShare = kIntervals / 10;
    for (int i = 0; i < kIntervals; ++i) {
        motion.advance(dt);
        const double energy = motion.vibration_energy();
        least = std::min(least, energy);
        most = std::max(most, energy);
        (i < kShare                 ? first
         : i >= kIntervals - kShare ? last
                                    : least) +=
            i < kShare || i >= kIntervals - kShare ? energy / kShare : 0;
    }
    std::printf("energy swings by %.2g of itself, drifts by %.2g\n", (most - least) / first,
                (last - first) / first);
    EXPECT_LT(std::fabs(last - first), 1e-4 * first);
    EXPECT_LT(most - least, 2e-2 * first);
    std::printf("coefficients in use: %zu of %zu\n", motion.cubic()->entries(), entries);
    EXPECT_LT(motion.cubic()->entries(), entries / 3); // twelve of its modes move
}

} // namespace
} // namespace ode::soft
