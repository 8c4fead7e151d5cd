#include "unit/model/specimens.h"

#include "base/error.h"
#include "base/thread_pool.h"
#include "mesh/generate.h"
#include "model/element_order.h"
#include "model/stvk_linear.h"
#include "model/stvk_quadratic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <set>

namespace ode::soft {
namespace {

/// Nodes numbered at random.
TetMesh shuffled(TetMesh mesh) {
    std::vector<int> to(mesh.node.size());
    std::iota(to.begin(), to.end(), 0);
    std::shuffle(to.begin(), to.end(), std::mt19937(3));
    const std::vector<Vec3> node = mesh.node;
    for (std::size_t i = 0; i < node.size(); ++i)
        mesh.node[static_cast<std::size_t>(to[i])] = node[i];
    for (int& n : mesh.element)
        n = to[static_cast<std::size_t>(n)];
    return mesh;
}

std::set<int> nodes_of(const TetMesh& mesh, const ElementSlab& slab) {
    std::set<int> out;
    for (const auto& list : slab.of_solid)
        for (const int e : list)
            for (const int node : mesh.nodes_of(static_cast<std::size_t>(e)))
                out.insert(node);
    return out;
}

void expect_good_order(const TetMesh& mesh, std::size_t least, std::size_t slabs) {
    const std::vector<ElementSlab> order = order_elements(mesh, 1, least);
    ASSERT_EQ(order.size(), slabs);
    std::vector<int> met(mesh.element_count());
    for (const ElementSlab& slab : order)
        for (const int e : slab.of_solid[0])
            ++met[static_cast<std::size_t>(e)];
    EXPECT_EQ(met, std::vector<int>(mesh.element_count(), 1));
    std::vector<std::set<int>> node;
    for (const ElementSlab& slab : order)
        node.push_back(nodes_of(mesh, slab));
    for (std::size_t a = 0; a < slabs; ++a) {
        EXPECT_GE(order[a].of_solid[0].size(), least);
        for (std::size_t b = a + 2; b < slabs; b += 2)
            EXPECT_TRUE(std::none_of(node[a].begin(), node[a].end(),
                                     [&](int n) { return node[b].count(n) != 0; }))
                << "slabs " << a << " and " << b << " have a node in common";
    }
}

TEST(ElementOrder, EveryOtherSlabHasNodesOfItsOwn) {
    const TetMesh bar = box_mesh({1, 0.1, 0.1}, 40, 4, 4); // 3840
    expect_good_order(bar, 100, 32);
    expect_good_order(bar, 300, 8);
    expect_good_order(with_mid_nodes(bar), 60, 32);
    expect_good_order(shuffled(bar), 100, 16); // slabs of one layer of cells would meet two others
    expect_good_order(make_bowl(0.1, 0.003, 1.6, 8, 48, 1), 60, 8);
}

TEST(ElementOrder, SmallMeshesAreOneSlab) {
    expect_good_order(box_mesh({1, 1, 1}, 3, 3, 3), 41, 1);
}

TEST(ElementOrder, AMeshThatCannotBeCutIsOneSlab) {
    // All elements share a node.
    TetMesh fan = box_mesh({1, 1, 1}, 4, 4, 4);
    for (std::size_t e = 0; e < fan.element_count(); ++e)
        fan.element[4 * e] = 0;
    expect_good_order(fan, 20, 1);
}

// The force of a mesh in slabs is the sum over its elements whoever adds them up, and the same bits
// for any number of threads.
template <class Packs>
void force_is_that_of_one_slab(const TetMesh& mesh) {
    // Two groups meet within slabs.
    TetMesh halves = mesh;
    for (std::size_t e = 0; e < mesh.element_count(); ++e)
        halves.group.push_back(static_cast<int>(e / 5 % 2));
    const std::vector<Solid> solids{viscous_rubber(), viscous_rubber()};
    const TetModel<StvkLaw, Packs> model(halves, solids);
    ASSERT_GE(Packs(halves, solids).blocks().back().slab, 3U);
    const NodeArray x = disturbed(node_array(mesh.node), 1e-3, 1);
    const NodeArray v = disturbed(NodeArray(x.size()), 0.1, 2);
    NodeArray alone(x.size());
    const StrainExtremes extremes = model.add_force(x, v, alone);

    for (const int threads : {2, 3, 7}) {
        ThreadPool pool(threads);
        const TasksScope scope(&pool);
        for (int round = 0; round < 20; ++round) {
            NodeArray together(x.size());
            const StrainExtremes same = model.add_force(x, v, together);
            ASSERT_EQ(std::memcmp(alone.data(), together.data(), 32 * x.size()), 0);
            ASSERT_EQ(std::memcmp(&extremes, &same, sizeof same), 0);
        }
    }
    // Virtual work: the derivative of the energy, to the accuracy of its central difference.
    const NodeArray along = disturbed(NodeArray(x.size()), 1, 5);
    NodeArray still(x.size()), elastic(x.size());
    model.add_force(x, still, elastic);
    constexpr double kStep = 1e-6;
    double work = 0;
    NodeArray ahead = x, behind = x;
    for (std::size_t i = 0; i < x.size(); ++i) {
        work -= elastic[i].dot(along[i]);
        ahead[i] += kStep * along[i];
        behind[i] -= kStep * along[i];
    }
    const double change = (model.energy(ahead) - model.energy(behind)) / (2 * kStep);
    EXPECT_NEAR(work, change, 1e-6 * std::fabs(change));
    EXPECT_NEAR(extremes.energy, model.energy(x), 1e-12 * extremes.energy);
}

TEST(ElementOrder, ForceIsTheSameForAnyNumberOfThreads) {
    const TetMesh bar = box_mesh({1, 0.1, 0.1}, 50, 4, 4); // 4800
    force_is_that_of_one_slab<Tet4Packs>(bar);
    force_is_that_of_one_slab<Tet10Packs>(with_mid_nodes(bar));
}

TEST(ElementOrder, NotANumberInOneSlabIsTold) {
    const TetMesh bar = box_mesh({1, 0.1, 0.1}, 50, 4, 4);
    const TetModel<StvkLaw, Tet4Packs> model(bar, rubber());
    NodeArray x = node_array(bar.node), force(x.size());
    x[x.size() / 3].x() = NAN;
    const StrainExtremes extremes = model.add_force(x, NodeArray(x.size()), force);
    EXPECT_FALSE(std::isfinite(extremes.energy));
    EXPECT_FALSE(extremes.min_jacobian > 0);
}

} // namespace
} // namespace ode::soft
