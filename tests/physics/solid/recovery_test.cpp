#include "physics/solid/free_body.h"

#include "model/stable_neo_hookean.h"

#include <gtest/gtest.h>

namespace ode::soft {
namespace {

// Stable neo-Hookean finds back from states that have no volume left or the wrong sign of it. Steps
// are a hundredth of the critical one at rest: a stretch of 5 stiffens by 5^2, its cofactor by 5^4.
template <class Model>
void recovers(TetMesh mesh, NodeArray start) {
    Solid jelly = rubber();
    jelly.phi = 100;
    jelly.psi = 100;
    const Model model(mesh, jelly);
    const NodeArray rest = node_array(mesh.node);
    FreeBody body(model, start);
    const double h = 0.01 * critical_step(model, body.inverse_mass, rest, viscous_time(jelly));
    const double before = model.energy(start);
    NodeArray force(rest.size());
    ASSERT_LT(model.add_force(start, NodeArray(rest.size()), force).min_jacobian, 0.01);
    StrainExtremes extremes;
    for (double t = 0; t < 0.3; t += h)
        extremes = body.step(h);
    EXPECT_NEAR(extremes.min_jacobian, 1, 1e-3);
    EXPECT_LE(model.energy(body.state.position), 1e-6 * before);
}

TEST(Recovery, OfABlockSquashedFlat) {
    const TetMesh mesh = irregular_box({0.1, 0.1, 0.1}, 2, 2, 2);
    NodeArray start = node_array(mesh.node);
    for (std::size_t i = 0; i < start.size(); ++i)
        start[i].z() *= 1e-3;
    recovers<StableNeoHookeanLinear>(mesh, start);
}

TEST(Recovery, OfABlockWithScrambledNodes) {
    const TetMesh mesh = irregular_box({0.1, 0.1, 0.1}, 2, 2, 2);
    recovers<StableNeoHookeanLinear>(mesh, disturbed(node_array(mesh.node), 0.05, 17));
}

TEST(Recovery, OfAQuadraticBlockSquashedFlat) {
    const TetMesh mesh = with_mid_nodes(irregular_box({0.1, 0.1, 0.1}, 2, 2, 2));
    NodeArray start = node_array(mesh.node);
    for (std::size_t i = 0; i < start.size(); ++i)
        start[i].z() *= 1e-3;
    recovers<StableNeoHookeanQuadratic>(mesh, start);
}

} // namespace
} // namespace ode::soft
