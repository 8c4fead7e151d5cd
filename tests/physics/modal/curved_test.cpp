// Curved bodies given by facets, against the same bodies with facets of half the size.
#include "base/error.h"
#include "mesh/generate.h"
#include "modal/to_tolerance.h"
#include "support/timoshenko.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ode::soft {
namespace {

const Solid kAluminium{.young = 69e9, .poisson = 0.33, .density = 2700};
constexpr std::size_t kPartials = 6;

ModalModel modes(const TetMesh& mesh, bool curved) {
    ModalOptions options;
    options.max_frequency = 1e6;
    options.max_modes = kPartials;
    options.verify = false;
    ToleranceOptions tolerance;
    tolerance.rebuild_curves = curved;
    return modes_to_tolerance(mesh, std::span(&kAluminium, 1), options, tolerance).model;
}

// On this thin bowl straight and rebuilt err alike on one mesh, from opposite sides; what must hold
// is the band. (On the sphere rebuilding wins a hundredfold: app/modes_test.cpp.)
TEST(Curved, BandOfARebuiltBowlHolds) {
    const TetMesh coarse = make_bowl(0.1, 0.005, 1.5708, 12, 40, 1);
    const ModalModel reference = modes(make_bowl(0.1, 0.005, 1.5708, 16, 56, 1), true);
    const ModalModel straight = modes(coarse, false), curved = modes(coarse, true);
    ASSERT_EQ(curved.mode_count(), kPartials);
    EXPECT_EQ(curved.node_count, coarse.node.size());
    for (std::size_t k = 0; k < kPartials; ++k) {
        const double error = std::abs(cents(curved.frequency[k], reference.frequency[k]));
        EXPECT_LE(error, curved.error_cents[k]);
        std::printf("bowl %zu: straight %+.2f, rebuilt %+.2f +- %.2f cents\n", k + 1,
                    cents(straight.frequency[k], reference.frequency[k]),
                    cents(curved.frequency[k], reference.frequency[k]), curved.error_cents[k]);
    }
}

// On a refined mesh the doubt about the surface stays what it was on the given one.
TEST(Curved, RefinementDoesNotArgueTheFacetsAway) {
    const TetMesh mesh = make_sphere(0.05, 2);
    ModalOptions options;
    options.max_frequency = 1e6;
    options.max_modes = 4;
    options.verify = false;
    ToleranceOptions tolerance;
    tolerance.partials = 4;
    const TolerantModes coarse =
        modes_to_tolerance(mesh, std::span(&kAluminium, 1), options, tolerance);
    const double reached =
        *std::max_element(coarse.model.error_cents.begin(), coarse.model.error_cents.end());
    tolerance.cents = 0.1 * reached;
    EXPECT_THROW(modes_to_tolerance(mesh, std::span(&kAluminium, 1), options, tolerance),
                 InputError);
    tolerance.rebuild_curves = false; // facets that are meant can be resolved
    tolerance.cents = 3;
    EXPECT_LE(modes_to_tolerance(mesh, std::span(&kAluminium, 1), options, tolerance)
                  .model.error_cents[0],
              3);
}

} // namespace
} // namespace ode::soft
