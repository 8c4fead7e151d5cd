// What stands between a rigid body that rings and an ear hides it, as it hides a soft one.
#include "support/rigid_ring.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace ode;
using test::RigidRing;

constexpr double kStep = 0.005;

struct Struck : RigidRing {
    Bar bar;

    Struck() : bar(add_bar(0, 0, 0)) {}
    dGeomID add_wall(dReal x) {
        const dGeomID wall = dCreateBox(space, 2, 0.1, 2);
        dGeomSetPosition(wall, x, -0.5, 0);
        return wall;
    }
    void strike(double seconds) {
        run(0.1, kStep);
        const dVector3 at = {0.08, 0.01, 0.01}, blow = {0, 0.001, -0.005};
        dSoundModalStrike(bar.voice, at, blow, 1e-4);
        run(seconds, kStep);
    }
    unsigned long rays() {
        dSoundStats s{};
        s.struct_size = sizeof s;
        dSoundGetStats(sound, &s);
        return s.rays;
    }
    double level(double begin, double end) const {
        const std::vector<double> all = heard();
        double sum = 0;
        for (auto i = static_cast<std::size_t>(begin * kRate);
             i < static_cast<std::size_t>(end * kRate) && i < all.size(); ++i)
            sum += all[i] * all[i];
        return std::sqrt(sum);
    }
};

std::vector<double> in_the_open(double seconds) {
    Struck app;
    app.strike(seconds);
    return app.heard();
}

TEST(RigidOcclusion, OffOrWithNothingBetweenNoRayIsCast) {
    const std::vector<double> open = in_the_open(0.3);
    Struck off;
    off.add_wall(0);
    off.strike(0.3);
    EXPECT_EQ(off.heard(), open);
    Struck clear; // its own geom is between it and the ear, in part
    dSoundSetOcclusion(clear.sound, clear.space, ~0ul);
    dCreatePlane(clear.space, 0, 0, 1, -1);
    dGeomSetPosition(dCreateSphere(clear.space, 0.2), 0, 3, 0);
    clear.strike(0.3);
    EXPECT_EQ(clear.rays(), 0u);
    EXPECT_EQ(clear.heard(), open);
}

TEST(RigidOcclusion, AWallDimsWhatRings) {
    Struck open;
    open.strike(0.4);
    Struck hidden;
    hidden.add_wall(0);
    dSoundSetOcclusion(hidden.sound, hidden.space, ~0ul);
    hidden.strike(0.4);
    EXPECT_GT(hidden.rays(), 100u);
    EXPECT_GT(open.level(0.2, 0.45), 1e-3);
    EXPECT_EQ(hidden.level(0.2, 0.45), 0.0);

    Struck half; // all of it on one side of the middle: five of nine points and less
    half.add_wall(-1);
    dSoundSetOcclusion(half.sound, half.space, ~0ul);
    half.strike(0.4);
    const double share = half.level(0.2, 0.45) / open.level(0.2, 0.45);
    EXPECT_GT(share, 0.4);
    EXPECT_LT(share, 0.6);

    Struck other; // a wall of a category that doesn't hide
    dGeomSetCategoryBits(other.add_wall(0), 2);
    dSoundSetOcclusion(other.sound, other.space, 1);
    other.strike(0.4);
    EXPECT_EQ(other.rays(), 0u);
    EXPECT_EQ(other.level(0.2, 0.45), open.level(0.2, 0.45));
}

// A wall that comes while it rings: no sample steps farther than the tone itself does.
TEST(RigidOcclusion, AWallThatComesMakesNoClick) {
    const std::vector<double> q = in_the_open(0.45);
    Struck app;
    dSoundSetOcclusion(app.sound, app.space, ~0ul);
    app.strike(0.15);
    const dGeomID wall = app.add_wall(0);
    app.run(0.1, kStep);
    dGeomSetPosition(wall, 5, 0, 0);
    app.run(0.2, kStep);
    const std::vector<double> p = app.heard();
    double own = 0, steepest = 0;
    for (std::size_t i = static_cast<std::size_t>(0.2 * RigidRing::kRate); i < p.size(); ++i) {
        if (i < q.size())
            own = std::max(own, std::fabs(q[i] - q[i - 1]));
        steepest = std::max(steepest, std::fabs(p[i] - p[i - 1]));
    }
    EXPECT_LT(steepest, 1.02 * own);
    EXPECT_LT(app.level(0.3, 0.33), 1e-3 * app.level(0.2, 0.23));
    for (std::size_t i = static_cast<std::size_t>(0.45 * RigidRing::kRate); i < p.size(); ++i)
        ASSERT_EQ(p[i], q[i]) << "gone, it is as if it had never been";
}

} // namespace
