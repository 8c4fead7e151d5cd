// A tilted bowl falls on the floor: its motion in modes, contact included, against the explicit run
// on the same elements.
#include "tier_run.h"

#include "couple/pole_contact.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ode::soft {
namespace {

struct Fallen {
    std::vector<AlignedVector<double>> rate; ///< of each mode, step by step
    Vec3 velocity, angular;
    double energy = 0;
    int changes = 0;
    bool bends = false; ///< at the end
    std::shared_ptr<const ModalBasis> basis;
};

/// @param basis  what motion is looked at by; nullptr: the body's own, in modes.
Fallen fall(TierChoice tier, int order, double speed, double time,
            std::shared_ptr<const ModalBasis> basis = nullptr) {
    constexpr double h = 1e-4, gravity = 9.81;
    TierRun run(tier, order, -gravity);
    Body& body = run.body();
    throw_down(run, 0.001, speed);
    Fallen out;
    for (double t = 0; t < time; t += h) {
        run.step(h);
        if (!basis)
            basis = body.modal_motion()->shared_basis();
        out.rate.push_back(audible(body, basis));
    }
    out.basis = basis;
    out.bends = body.bends();
    out.changes = static_cast<int>(body.tier_changes());
    out.velocity = body.linear_momentum() / body.total_mass();
    out.angular = body.angular_momentum();
    out.energy = body.kinetic_energy() + body.elastic_energy() +
                 gravity * body.total_mass() * body.center_of_mass().z();
    return out;
}

class Fall : public testing::TestWithParam<std::tuple<int, double, double>> {};

// Contact sees modes up to 77 kHz and the rest as if it stood still. What is left is that rest
// (modes to 88 kHz: 0.7 % in the first case), the explicit run's own period error and, in the last
// case, what isn't linear in a blow that bends the rim by a tenth of its thickness.
TEST_P(Fall, InModesIsNearTheExplicitOne) {
    const auto [order, speed, most] = GetParam();
    const double time = order == 1 ? 0.02 : 0.004;
    const Fallen modes = fall(TierChoice::modes, order, speed, time);
    const Fallen nodes = fall(TierChoice::explicit_space, order, speed, time, modes.basis);
    const double error = audible_error(modes.rate, nodes.rate);
    std::printf(
        "order %d, %g m/s: waveform error %.1f %%, velocity after the blow off by %.1f %%\n", order,
        speed, 100 * error, 100 * (modes.velocity - nodes.velocity).norm() / speed);
    EXPECT_LT(error, most);
    EXPECT_LT((modes.velocity - nodes.velocity).norm(), 0.03 * speed);
    EXPECT_LT((modes.angular - nodes.angular).norm(), 0.01 * nodes.angular.norm());
    EXPECT_NEAR(modes.energy, nodes.energy, 0.002 * nodes.energy);
}

INSTANTIATE_TEST_SUITE_P(Speeds, Fall,
                         testing::Values(std::tuple(1, 0.5, 0.02), std::tuple(1, 2.0, 0.025),
                                         std::tuple(2, 0.5, 0.02), std::tuple(2, 2.0, 0.06)));

// With what isn't linear of the lowest 36 modes: 2.2 %, of which 1.3 are the contact's, 4.8
// without.
TEST(CubicFall, IsWithinTheToleranceOfTheExplicitOne) {
    constexpr double kTime = 0.004, kSpeed = 2;
    const Fallen modes = fall(TierChoice::cubic, 2, kSpeed, kTime);
    const Fallen nodes = fall(TierChoice::explicit_space, 2, kSpeed, kTime, modes.basis);
    const double error = audible_error(modes.rate, nodes.rate);
    std::printf("order 2, %g m/s, cubic: waveform error %.2f %%\n", kSpeed, 100 * error);
    EXPECT_LT(error, 0.025);
    EXPECT_LT((modes.velocity - nodes.velocity).norm(), 0.01 * kSpeed);
    EXPECT_NEAR(modes.energy, nodes.energy, 0.002 * nodes.energy);
    // Automatically, it is what such a blow is met in.
    const Fallen either = fall(TierChoice::automatic, 2, kSpeed, kTime, modes.basis);
    std::printf("auto: %.2f %%, %d changes of tier\n", 100 * audible_error(either.rate, nodes.rate),
                either.changes);
    EXPECT_TRUE(either.bends);
    EXPECT_LT(audible_error(either.rate, nodes.rate), 0.025);
}

// A gentle blow is taken in modes; one that bends the bowl much, and its ring, node by node.
class AutomaticFall : public testing::TestWithParam<double> {};

TEST_P(AutomaticFall, KeepsTheToleranceOfTheExplicitOne) {
    const double speed = GetParam();
    constexpr double kTime = 0.03, kBending = 10;
    const Fallen modes = fall(TierChoice::modes, 1, speed, 0.001);
    const Fallen either = fall(TierChoice::automatic, 1, speed, kTime, modes.basis);
    const Fallen nodes = fall(TierChoice::explicit_space, 1, speed, kTime, modes.basis);
    const double error = audible_error(either.rate, nodes.rate);
    std::printf("%g m/s: waveform error %.2f %%, %d changes of tier\n", speed, 100 * error,
                either.changes);
    EXPECT_EQ(either.changes == 0, speed > kBending);
    EXPECT_LT(error, 0.025);
    EXPECT_LT((either.velocity - nodes.velocity).norm(), 0.025 * speed);
}
INSTANTIATE_TEST_SUITE_P(Speeds, AutomaticFall, testing::Values(0.5, 2.0, 15.0));

// Nothing near: a step is one substep, and no element is evaluated. Before the floor comes near,
// looks from ever closer tell that nothing can touch yet.
TEST(Flight, OfAModalBodyCostsASubstepAStep) {
    TierRun run(TierChoice::modes, 1, -9.81);
    dCreatePlane(run.space(), 0, 0, 1, 0);
    run.body().move_to({0, 0, 5});
    for (int i = 0; i < 100; ++i)
        run.step(1e-3);
    EXPECT_EQ(run.world().stats().substeps, 100u);
    EXPECT_EQ(run.world().stats().modal_substeps, 100u);
    EXPECT_EQ(run.world().stats().element_steps, 0u);
    EXPECT_NEAR(run.body().center_of_mass().z() - 5, -9.81 * 0.1 * 0.1 / 2, 1e-9);
}

/// How near a floor at z = 0 the curved surface is where a substep ends that bore nothing.
class LeapWatch final : public Observer {
public:
    explicit LeapWatch(const Body& body) : surface_(body.mesh(), body.surface(), body.mass()) {}

    bool wants_substeps() const noexcept override { return true; }
    bool takes_modes() const noexcept override { return true; }
    void on_substep(const SubstepView& view) noexcept override {
        if (view.body.bearing_points() != 0) {
            ++bearing;
            return;
        }
        ++free;
        if (view.dt < kLeap) // in what it parts from it may be yet
            return;
        const NodeArray& position = view.body.shown_state().position;
        for (std::size_t t = 0; t < surface_.triangle.size(); ++t) {
            Vec3 depth, where;
            for (int i = 0; i < 3; ++i)
                depth[i] = -position[static_cast<std::size_t>(
                                         surface_.triangle[t][static_cast<std::size_t>(i)])]
                                .z();
            deepest = std::max(deepest, highest_point(depth, surface_.shape.bulge[t], where));
        }
    }
    void on_step(SoftWorld&, double) noexcept override {}
    void on_body_end(Body&) noexcept override {}
    void on_world_end(SoftWorld&) noexcept override {}

    long bearing = 0, free = 0;
    static constexpr double kLeap = 1.2e-5; ///< longer than any substep of contact [s]
    double deepest = -1;                    ///< where nothing bears [m]

private:
    SurfaceNodes surface_;
};

// A bowl that rings and bounces leaps from touch to touch: no leap ends in the floor, though the
// rim swings by as much as the bowl flies high; it took ten times as many substeps when what is
// near was looked at in each.
TEST(Flight, BetweenTouchesIsLeaptOver) {
    TierRun run(TierChoice::modes, 1, -9.81);
    throw_down(run, 0.001, 1.0);
    auto watch = std::make_unique<LeapWatch>(run.body());
    const LeapWatch& seen = *watch;
    run.world().add_observer(std::move(watch));
    for (int i = 0; i < 800; ++i)
        run.step(1e-3);
    std::printf("%ld substeps that bear, %ld others, %lu nodes looked at; the deepest that was "
                "leapt into is %.2g m\n",
                seen.bearing, seen.free, run.world().stats().contact_tests, seen.deepest);
    EXPECT_GT(seen.bearing, 500);
    EXPECT_LT(seen.free, 800 + seen.bearing);
    EXPECT_LT(seen.deepest, 1e-7);
}

} // namespace
} // namespace ode::soft
