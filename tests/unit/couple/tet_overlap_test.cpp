#include "couple/tet_overlap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ode::soft {
namespace {

const Tet kCorner{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};

Tet moved(Tet t, const Vec3& by) {
    for (Vec3& x : t)
        x += by;
    return t;
}

// {x, y, z >= 0, x + y + z <= 1} meets itself, moved by a positive vector v, in a copy of itself
// smaller by 1 - v.x - v.y - v.z, at v.
TEST(TetOverlap, CopyOfItselfMoved) {
    for (const double t : {0.0, 0.1, 0.5, 0.9, 0.999}) {
        const Vec3 by = t * Vec3(0.5, 0.3, 0.2);
        TetOverlap o{};
        ASSERT_TRUE(overlap_of(kCorner, moved(kCorner, by), o)) << t;
        const double size = 1 - t;
        EXPECT_NEAR(o.volume, size * size * size / 6, 1e-15);
        EXPECT_LT((o.center - (by + Vec3::Constant(size / 4))).norm(), 1e-12 / size);
    }
    TetOverlap o{};
    EXPECT_FALSE(overlap_of(kCorner, moved(kCorner, Vec3(0.5, 0.3, 0.2)), o));
    EXPECT_FALSE(overlap_of(kCorner, moved(kCorner, Vec3(3, 0, 0)), o));
}

TEST(TetOverlap, OneInsideTheOther) {
    Tet small = kCorner;
    for (Vec3& x : small)
        x = 0.1 * x + Vec3::Constant(0.2);
    TetOverlap o{};
    ASSERT_TRUE(overlap_of(kCorner, small, o));
    EXPECT_NEAR(o.volume, 1e-3 / 6, 1e-17);
    for (const Vec3& g : o.gradient[0]) // no face of the large one bounds it
        EXPECT_EQ(g.norm(), 0);
}

struct Random {
    std::mt19937 random{1};
    std::uniform_real_distribution<double> u{-1, 1};
    Tet tet() {
        for (;;) {
            Tet t;
            for (Vec3& x : t)
                x = Vec3(u(random), u(random), u(random));
            const double volume = (t[1] - t[0]).cross(t[2] - t[0]).dot(t[3] - t[0]) / 6;
            if (volume > 0.05)
                return t;
        }
    }
};

TEST(TetOverlap, GradientAgreesWithDifferences) {
    Random random;
    int met = 0;
    for (int i = 0; i < 200; ++i) {
        std::array<Tet, 2> t{random.tet(), random.tet()};
        TetOverlap o{};
        if (!overlap_of(t[0], t[1], o) || o.volume < 1e-3)
            continue;
        ++met;
        const double h = 1e-6;
        for (std::size_t side = 0; side < 2; ++side)
            for (std::size_t corner = 0; corner < 4; ++corner)
                for (int axis = 0; axis < 3; ++axis) {
                    TetOverlap up{}, down{};
                    std::array<Tet, 2> bent = t;
                    bent[side][corner][axis] += h;
                    ASSERT_TRUE(overlap_of(bent[0], bent[1], up));
                    bent[side][corner][axis] -= 2 * h;
                    ASSERT_TRUE(overlap_of(bent[0], bent[1], down));
                    // Second derivatives jump where an edge passes an edge: first order in h.
                    EXPECT_NEAR(o.gradient[side][corner][axis], (up.volume - down.volume) / (2 * h),
                                1e-5);
                }
    }
    EXPECT_GT(met, 50);
}

// The volume doesn't change when both move as one: neither forces nor couples are left over.
TEST(TetOverlap, GradientHasNoSumAndNoCouple) {
    Random random;
    for (int i = 0; i < 200; ++i) {
        const std::array<Tet, 2> t{random.tet(), random.tet()};
        TetOverlap o{};
        if (!overlap_of(t[0], t[1], o))
            continue;
        Vec3 sum = Vec3::Zero();
        Vec3 couple = Vec3::Zero();
        for (std::size_t side = 0; side < 2; ++side)
            for (std::size_t corner = 0; corner < 4; ++corner) {
                sum += o.gradient[side][corner];
                couple += t[side][corner].cross(o.gradient[side][corner]);
            }
        EXPECT_LT(sum.norm(), 1e-14);
        EXPECT_LT(couple.norm(), 1e-14);
    }
}

TEST(TetOverlap, FaceFilterNeverDropsAnOverlap) {
    Random random;
    int kept = 0;
    int apart = 0;
    for (int i = 0; i < 2000; ++i) {
        const Tet a = random.tet();
        const Tet b = moved(random.tet(), 2 * Vec3(random.u(random.random), 0, 0));
        const double gap = face_gap(a, b);
        const bool separate = gap > 0;
        TetOverlap o{};
        const bool met = overlap_of(a, b, o);
        EXPECT_FALSE(separate && met);
        if (separate) { // moved by less than the gap, whichever way, they still don't meet
            EXPECT_FALSE(overlap_of(a, moved(b, Vec3(-0.999 * gap, 0, 0)), o));
        }
        kept += !separate;
        apart += !met;
    }
    EXPECT_GT(kept, 100);
    EXPECT_GT(apart, 100);
}

} // namespace
} // namespace ode::soft
