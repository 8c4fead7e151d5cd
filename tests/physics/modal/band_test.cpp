// The library's own statement of its error, against references on meshes of half the size.
#include "scenes/timoshenko.h"
#include "support/pitch_cases.h"

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
    std::vector<double> truth = reference.frequency; // by rank on a mesh of its own
    if (c.reference.element.empty())
        truth = matched_frequencies(model, reference);
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
    const TetMesh fine = c.reference.element.empty() ? refined(c.mesh) : c.reference;
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

} // namespace
} // namespace ode::soft
