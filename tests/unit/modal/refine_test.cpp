#include "modal/refine.h"

#include "mesh/generate.h"

#include <gtest/gtest.h>

namespace ode::soft {
namespace {

// Oracle: the same cubic problem factorised. What refinement misses of the change from quadratic to
// cubic must be small against the band, which is half of that change.
TEST(Refine, CapturesTheCubicSolutionWithoutItsFactor) {
    const Solid solid{.young = 69e9, .poisson = 0.33, .density = 2700};
    const TetMesh mesh = make_bar(0.3, 0.02, 0.01, 12, 2, 1);
    for (const bool clamp : {false, true}) {
        ModalOptions low, high;
        low.order = 2;
        high.order = 3;
        low.max_frequency = 16000;
        high.max_frequency = 10000;
        for (std::size_t i = 0; i < mesh.node.size() && clamp; ++i)
            if (mesh.node[i].x() < 1e-9)
                low.clamped.push_back(static_cast<int>(i));
        high.clamped = low.clamped;
        ModalProblem coarse(mesh, std::span(&solid, 1), low),
            fine(mesh, std::span(&solid, 1), high);
        const EigenPairs pairs = coarse.solve();
        const Transfer up(coarse.map(), coarse.held(), fine.map(), fine.held());
        const TwoLevel inverse(fine.system(), up, [&](RowMatrixF& x) {
            RowMatrix wide = x.cast<double>();
            coarse.factor().solve(wide);
            x = wide.cast<float>();
        });
        const Refined refined = refine(pairs, up, fine, inverse, {.share = 0.03, .steps = 8});
        const EigenPairs exact = fine.solve();
        ASSERT_GT(exact.value.size(), 8);
        ASSERT_GT(refined.value.size(), exact.value.size());
        for (Eigen::Index k = 0; k < exact.value.size(); ++k) {
            const double change = pairs.value[k] - exact.value[k]; // min-max: the spaces are nested
            const double missed = refined.value[k] - exact.value[k];
            EXPECT_GT(change, 0) << k;
            EXPECT_LT(missed, 0.03 * change) << k;
            EXPECT_GT(missed, -1e-7 * exact.value[k]) << "Ritz values lie above, mode " << k;
        }
    }
}

} // namespace
} // namespace ode::soft
