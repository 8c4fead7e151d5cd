// A chain of masses and springs whose every mode rings, stepped by central difference with nobody
// to take it back: below its critical step the watch is silent, above it the watch is faster than
// the energy.
#include "source/flow_history.h"
#include "source/growth_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

namespace ode::sound {
namespace {

/// n equal masses between walls: w_k = 2 sqrt(k/m) sin(k pi / (2 (n + 1))), critical step
/// 2 / w_n.
class Chain {
public:
    static constexpr int kNodes = 64;

    /// Flung out of rest: every node at random, and its five lowest modes.
    Chain(double share, double noise, double low, double drift)
        : x_(kNodes + 2), v_(kNodes + 2), drift_(drift) {
        step_ = share / std::sin(kNodes * M_PI / (2.0 * (kNodes + 1)));
        std::mt19937 bits(7);
        for (int i = 1; i <= kNodes; ++i) {
            v_[at(i)] = noise * (2.0 * double(bits()) / double(std::mt19937::max()) - 1.0);
            for (int k = 1; k <= 5; ++k)
                v_[at(i)] += low * std::sin(k * i * M_PI / (kNodes + 1));
        }
    }

    /// @return whether the watch called.
    bool advance(FlowHistory& history, GrowthWatch& watch) {
        std::vector<double> pull(x_.size());
        for (int i = 1; i <= kNodes; ++i)
            pull[at(i)] = x_[at(i - 1)] - 2.0 * x_[at(i)] + x_[at(i + 1)];
        double* volume = history.push(time_, time_ + kSecond * step_, false);
        for (int i = 1; i <= kNodes; ++i) {
            v_[at(i)] += step_ * pull[at(i)];
            x_[at(i)] += step_ * v_[at(i)];
            volume[i - 1] = step_ * (v_[at(i)] + drift_); // as if it flew
        }
        time_ += kSecond * step_;
        return watch.look(history, true);
    }
    double energy() const {
        double sum = 0.0;
        for (int i = 0; i <= kNodes; ++i) {
            sum += 0.5 * v_[at(i)] * v_[at(i)];
            sum += 0.5 * std::pow(x_[at(i + 1)] - x_[at(i)], 2.0);
        }
        return sum;
    }

private:
    static constexpr double kSecond = 1e-3; // of the chain's own time: each interval is looked at
    static std::size_t at(int i) { return static_cast<std::size_t>(i); }
    std::vector<double> x_, v_;
    double step_, drift_, time_ = 0.0;
};

TEST(GrowthWatch, IsSilentBelowTheCriticalStep) {
    for (const double share : {0.05, 0.3, 0.7, 0.9, 0.97, 0.999, 1.0})
        for (const double drift : {0.0, 100.0}) {
            Chain chain(share, 1.0, 0.0, drift);
            FlowHistory history(Chain::kNodes, 10);
            GrowthWatch watch;
            for (int i = 0; i < 20000; ++i)
                ASSERT_FALSE(chain.advance(history, watch)) << share << ", substep " << i;
        }
}

struct Call {
    int substep;
    double energy; ///< over that after the first substep
};

Call called(Chain chain) {
    FlowHistory history(Chain::kNodes, 10);
    GrowthWatch watch;
    chain.advance(history, watch);
    const double start = chain.energy();
    int steps = 2;
    while (steps < 2000 && !chain.advance(history, watch))
        ++steps;
    return {steps, chain.energy() / start};
}

// Where all modes ring alike the first few that are unstable must outgrow all others before they
// can be told from them, and two quotients take seven substeps, in which energy grows as much as it
// likes (3e8 fold at 1.3); where a body rings in its low modes, as bodies do, there is time.
TEST(GrowthWatch, CallsBeforeEnergyHasGrownTenfold) {
    for (const double share : {1.001, 1.003, 1.01, 1.03, 1.1, 1.3})
        for (const double drift : {0.0, 100.0}) {
            const Call low = called(Chain(share, 1e-6, 1.0, drift));
            const Call all = called(Chain(share, 1.0, 0.0, drift));
            std::printf("%g of the critical step: rings in low modes: called in substep %d, "
                        "energy x %.6f; in all alike: %d, x %.3g\n",
                        share, low.substep, low.energy, all.substep, all.energy);
            EXPECT_LT(low.energy, 10.0) << share;
            EXPECT_LT(all.substep, 100) << share;
        }
}

} // namespace
} // namespace ode::sound
