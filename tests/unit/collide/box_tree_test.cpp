#include "collide/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace ode::soft {
namespace {

std::vector<Aabb> random_boxes(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-1, 1);
    std::uniform_real_distribution<double> size(0, 0.1);
    std::vector<Aabb> out(count);
    for (Aabb& box : out) {
        box.include(Vec3(place(random), place(random), place(random)));
        box.include(Vec3(box.low + Vec3(size(random), size(random), size(random))));
    }
    return out;
}

/// near() against all elements one by one.
void expect_all_found(const BoxTree& tree, const std::vector<Aabb>& box, const Aabb& around,
                      double reach) {
    std::vector<int> visits(box.size());
    const double beyond =
        tree.near(around, reach, [&](int e) { ++visits[static_cast<std::size_t>(e)]; });
    for (std::size_t e = 0; e < box.size(); ++e) {
        const double distance = std::sqrt(around.distance2(box[e]));
        if (distance < reach) {
            EXPECT_EQ(visits[e], 1) << e;
        }
        EXPECT_LE(visits[e], 1) << e;
        if (visits[e] == 0) {
            EXPECT_GE(distance, beyond) << e;
        }
    }
}

TEST(BoxTree, FindsWhatIsNearAndBoundsTheRest) {
    for (const std::size_t count : {1, 2, 3, 7, 200}) {
        const std::vector<Aabb> box = random_boxes(count, 3);
        const BoxTree tree(box);
        for (const Aabb& around : random_boxes(20, 4))
            for (const double reach : {1e-3, 0.1, 0.5, 4.0})
                expect_all_found(tree, box, around, reach);
    }
}

TEST(BoxTree, FindsWhatHasMovedOnceItIsRefitted) {
    const std::vector<Aabb> rest = random_boxes(100, 5);
    const std::vector<Aabb> moved = random_boxes(100, 6); // neighbours no more
    BoxTree tree(rest);
    tree.refit([&](int e) { return moved[static_cast<std::size_t>(e)]; });
    Aabb all = Aabb::empty();
    for (const Aabb& box : moved)
        all.include(box);
    EXPECT_EQ(tree.bounds().low, all.low);
    EXPECT_EQ(tree.bounds().high, all.high);
    for (const Aabb& around : random_boxes(20, 7))
        expect_all_found(tree, moved, around, 0.2);
}

TEST(BoxTree, VisitsFewForAPointAmongMany) {
    const std::vector<Aabb> box = random_boxes(4000, 8);
    const BoxTree tree(box);
    int visits = 0;
    tree.near({Vec3::Zero(), Vec3::Zero()}, 0.05, [&](int) { ++visits; });
    const auto within = std::count_if(box.begin(), box.end(), [](const Aabb& b) {
        return b.distance2({Vec3::Zero(), Vec3::Zero()}) < 0.05 * 0.05;
    });
    EXPECT_LE(visits, 8 * within + 8);
    EXPECT_LT(visits, 100);
}

TEST(BoxTree, OfNothingIsEmptyAndFarFromEverything) {
    const BoxTree tree;
    EXPECT_TRUE(tree.bounds().is_empty());
    const double beyond = tree.near({Vec3::Zero(), Vec3::Zero()}, 1, [](int) { FAIL(); });
    EXPECT_EQ(beyond, std::numeric_limits<double>::infinity());
}

} // namespace
} // namespace ode::soft
