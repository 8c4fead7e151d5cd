// The library's own statement of its error, against references on meshes of half the size.
#include "mesh/generate.h"
#include "mesh/promote.h"
#include "support/pitch_cases.h"
#include "support/timoshenko.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

namespace ode::soft {
namespace {

struct Verdict {
    int partials = 0, bounded = 0;
    double worst = 0;          ///< of the first eight partials of a body [cents]
    std::vector<double> ratio; ///< band over true error

    double median() {
        std::nth_element(ratio.begin(),
                         ratio.begin() + static_cast<std::ptrdiff_t>(ratio.size() / 2),
                         ratio.end());
        return ratio[ratio.size() / 2];
    }
    void print(const char* what) {
        std::printf("%s: %d of %d bounded, median band / error %.2f, worst of eight %.2f cents\n",
                    what, bounded, partials, median(), worst);
    }
};

void judge(const PitchCase& c, int order, const ModalModel& reference, Verdict& verdict) {
    ModalOptions options = options_for(c, c.mesh);
    options.order = order;
    options.verify = false;
    const ModalModel model = solve_modes(c.mesh, c.solids, options);
    const std::vector<double> truth = matched_frequencies(model, reference);
    double worst = 0;
    for (std::size_t k = 0; k < model.mode_count(); ++k) {
        if (truth[k] == 0)
            continue; // mixed beyond recognition on the coarse mesh: no partner to judge by
        const double error = std::abs(cents(model.frequency[k], truth[k]));
        ++verdict.partials;
        verdict.bounded += error <= model.error_cents[k];
        if (error > model.error_cents[k])
            std::printf("  %s, order %d, partial %zu: %.2f, band %.2f cents\n", c.name.c_str(),
                        order, k + 1, error, model.error_cents[k]);
        if (error > 0.05) // below, the reference itself is in doubt
            verdict.ratio.push_back(model.error_cents[k] / error);
        if (k < 8)
            worst = std::max(worst, error);
    }
    if (order == 3)
        std::printf("  %s: worst %.2f cents\n", c.name.c_str(), worst), std::fflush(stdout);
    verdict.worst = std::max(verdict.worst, worst);
}

/// Half as large elements err by a fifth (clamped edges) to a hundredth of the coarse ones.
ModalModel reference_of(const PitchCase& c) {
    const TetMesh fine = refined(c.mesh);
    ModalOptions options = options_for(c, fine);
    options.max_modes += 3;
    options.max_frequency *= 1.1;
    options.verify = false;
    return solve_modes(fine, c.solids, options);
}

void expect_bounded(const std::vector<PitchCase>& cases, int least_partials) {
    Verdict quadratic, cubic;
    for (const PitchCase& c : cases) {
        if (c.name == "tube" || c.name == "sphere" || c.name == "clamped glass cup")
            continue; // long references: bench_pitch has them
        const ModalModel reference = reference_of(c);
        judge(c, 2, reference, quadratic);
        judge(c, 3, reference, cubic);
    }
    quadratic.print("quadratic");
    cubic.print("cubic");
    for (Verdict* v : {&quadratic, &cubic}) {
        EXPECT_GT(v->partials, least_partials);
        EXPECT_GE(v->bounded, 0.95 * v->partials);
        EXPECT_LE(v->median(), 4);
    }
    EXPECT_LE(cubic.worst, 17); // the mark for drafts
}

TEST(Band, BoundsTheTrueErrorWhereItWasCalibrated) { expect_bounded(pitch_cases(), 70); }

TEST(Band, BoundsTheTrueErrorOfBodiesHeldOut) { expect_bounded(held_out_cases(), 70); }

// The reference of the most singular case, against a mesh that is no kin of it: cells shrink by
// three toward the clamped edges, so that its own error is below a cent.
TEST(Band, ReferenceOfTheClampedPlateAgreesWithAGradedMesh) {
    const auto cases = pitch_cases();
    const auto plate = std::find_if(cases.begin(), cases.end(),
                                    [](const PitchCase& c) { return c.name == "clamped plate"; });
    ASSERT_NE(plate, cases.end());
    PitchCase graded = *plate;
    graded.mesh = make_plate(0.3, 0.3, 0.006, 12, 12, 1);
    // Cell boundaries from the middle to the edge, as shares of half the side.
    const double line[] = {0, 0.24, 0.48, 0.72, 0.9, 0.967, 1};
    for (Vec3& x : graded.mesh.node)
        for (int axis = 0; axis < 2; ++axis) {
            const auto step = static_cast<std::size_t>(std::lround(std::abs(x[axis]) / 0.025));
            x[axis] = std::copysign(0.15 * line[step], x[axis]);
        }
    graded.mesh = promote_to_quadratic(graded.mesh);
    ModalOptions options = options_for(graded, graded.mesh);
    options.max_modes = 8;
    const ModalModel truth = solve_modes(graded.mesh, graded.solids, options);
    const ModalModel reference = reference_of(*plate);
    for (std::size_t k = 0; k < 8; ++k) {
        const double apart = cents(reference.frequency[k], truth.frequency[k]);
        std::printf("clamped plate %zu: reference %+.2f +- %.2f, graded +- %.2f cents\n", k + 1,
                    apart, reference.error_cents[k], truth.error_cents[k]);
        EXPECT_LE(std::abs(apart), reference.error_cents[k] + truth.error_cents[k]);
        EXPECT_LE(std::abs(apart), 1.5);
    }
}

} // namespace
} // namespace ode::soft
