// A bowl in free flight, struck at its rim by a pulse of 0.3 ms: its vibration in modes against the
// explicit, non-linear run on the same elements.
#include "tier_run.h"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

namespace ode::soft {
namespace {

struct Struck {
    std::vector<double> signal; ///< of a node [m/s]
    Vec3 momentum, impulse = Vec3::Zero();
    double bent = 0; ///< largest displacement over the thickness, in modes
};

/// The node that is farthest along a direction.
int farthest(const TetMesh& mesh, const Vec3& direction) {
    int best = 0;
    for (std::size_t i = 0; i < mesh.node.size(); ++i)
        if (mesh.node[i].dot(direction) > mesh.node[static_cast<std::size_t>(best)].dot(direction))
            best = static_cast<int>(i);
    return best;
}

constexpr double kFine = 1e-5; ///< ODE's step [s]

/// @param after  ODE's step after the pulse, a multiple of kFine [s].
Struck strike(TierChoice tier, int order, double force, const Vec3& spin, double time,
              double after = kFine) {
    constexpr double pulse = 3e-4;
    TierRun run(tier, order);
    Body& body = run.body();
    body.add_spin(spin);
    const int rim = farthest(body.mesh(), {1, 0, 1});
    const auto heard = static_cast<std::size_t>(farthest(body.mesh(), {0, -1, 1}));
    const Vec3 inward =
        (body.center_of_mass() - body.mesh().node[static_cast<std::size_t>(rim)]).normalized();
    std::vector<int> all(body.mesh().node.size());
    std::iota(all.begin(), all.end(), 0);
    Struck out;
    double h = kFine;
    for (double t = 0; t < time - kFine / 2; t += h) {
        h = t < pulse - kFine / 2 ? kFine : after;
        if (t < pulse - kFine / 2) {
            const double phase = 2 * std::numbers::pi * (t + h / 2) / pulse;
            const Vec3 now = force * (1 - std::cos(phase)) / 2 * inward;
            body.add_force(rim, now);
            out.impulse += h * now;
        }
        run.step(h);
        if (body.rings()) {
            ModalMotion now = *body.modal_motion();
            out.bent = std::max(out.bent, now.displacement_envelope(all) / 0.005);
        }
        const Vec3 arm = body.state().position[heard] - body.center_of_mass();
        out.signal.push_back(
            (body.state().velocity[heard] - spin.cross(arm)).dot(Vec3(1, 2, 3).normalized()));
    }
    out.momentum = body.linear_momentum();
    return out;
}

struct Case {
    int order;
    double force; ///< [N]
    Vec3 spin;    ///< [rad/s]
    double most;  ///< relative error
};

class FreeStrike : public testing::TestWithParam<Case> {};

TEST_P(FreeStrike, InModesIsTheExplicitOne) {
    const Case& c = GetParam();
    constexpr double kTime = 0.02;
    const Struck nodes = strike(TierChoice::explicit_space, c.order, c.force, c.spin, kTime);
    const Struck modes = strike(TierChoice::modes, c.order, c.force, c.spin, kTime);
    const double error = relative_error(modes.signal, nodes.signal);
    std::printf("order %d, %g N, spin %g rad/s: waveform error %.3f %%\n", c.order, c.force,
                c.spin.norm(), 100 * error);
    EXPECT_LT(error, c.most);
    // What spins holds momentum in each of its nodes that sums to nothing but for rounding.
    const double rounding = 1e-12 * modes.impulse.norm() + 1e-12 * c.spin.norm();
    EXPECT_LT((modes.momentum - modes.impulse).norm(), rounding);
}

struct CubicCase {
    double force;  ///< [N]
    double linear; ///< error of the linear tier is above
    double cubic;  ///< below
};

class CubicStrike : public testing::TestWithParam<CubicCase> {};

// Marks at 0.02, 0.1 and 0.25 thicknesses, on quadratic elements.
TEST_P(CubicStrike, IsNearTheExplicitOne) {
    const CubicCase& c = GetParam();
    constexpr double kTime = 0.01;
    const Struck nodes = strike(TierChoice::explicit_space, 2, c.force, Vec3::Zero(), kTime);
    const Struck modes = strike(TierChoice::modes, 2, c.force, Vec3::Zero(), kTime);
    const Struck cubic = strike(TierChoice::cubic, 2, c.force, Vec3::Zero(), kTime);
    const double linear_error = relative_error(modes.signal, nodes.signal);
    const double error = relative_error(cubic.signal, nodes.signal);
    std::printf("%g N, %.3f thicknesses: waveform error linear %.2f %%, cubic %.3f %%\n", c.force,
                modes.bent, 100 * linear_error, 100 * error);
    EXPECT_GT(linear_error, c.linear);
    EXPECT_LT(error, c.cubic);
    EXPECT_LT((cubic.momentum - cubic.impulse).norm(), 1e-12 * cubic.impulse.norm());
    // As an application steps: the longest intervals that there are.
    constexpr double kCoarse = 2.5e-4;
    const auto pulse = static_cast<std::size_t>(std::lround(3e-4 / kFine));
    const auto every = static_cast<std::size_t>(std::lround(kCoarse / kFine));
    const Struck coarse =
        strike(TierChoice::cubic, 2, c.force, Vec3::Zero(), 3e-4 + 38 * kCoarse, kCoarse);
    std::vector<double> seen, reference;
    for (std::size_t i = 0; pulse + i < coarse.signal.size(); ++i) {
        seen.push_back(coarse.signal[pulse + i]);
        reference.push_back(nodes.signal[pulse - 1 + (i + 1) * every]);
    }
    ASSERT_EQ(seen.size(), 38u);
    const double coarse_error = relative_error(seen, reference);
    std::printf("  in steps of a quarter millisecond: %.3f %%\n", 100 * coarse_error);
    EXPECT_LT(coarse_error, c.cubic);
}

INSTANTIATE_TEST_SUITE_P(Amplitudes, CubicStrike,
                         testing::Values(CubicCase{800, 0.004, 0.002}, CubicCase{4000, 0.02, 0.006},
                                         CubicCase{10000, 0.05, 0.02}));

INSTANTIATE_TEST_SUITE_P(Amplitudes, FreeStrike,
                         testing::Values(Case{1, 30, {0, 0, 0}, 0.001},
                                         Case{1, 3000, {0, 0, 0}, 0.0015},
                                         Case{1, 30000, {0, 0, 0}, 0.01},
                                         Case{1, 300, {0, 0, 60}, 0.02},
                                         Case{2, 100, {0, 0, 0}, 0.001}));

} // namespace
} // namespace ode::soft
