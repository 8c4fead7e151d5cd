// The library's own statement of its error, against references on meshes of half the size.
#include "support/pitch_cases.h"
#include "support/timoshenko.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ode::soft {
namespace {

struct Verdict {
    int partials = 0, bounded = 0;
    std::vector<double> ratio; ///< band over true error
};

/// Both answers by their own band, the reference's error counted as uncertainty of the truth.
void judge(const PitchCase& c, int order, const ModalModel& reference, Verdict& verdict) {
    ModalOptions options = options_for(c, c.mesh);
    options.order = order;
    options.verify = false;
    const ModalModel model = solve_modes(c.mesh, c.solids, options);
    const std::vector<double> truth = matched_frequencies(model, reference);
    for (std::size_t k = 0; k < model.mode_count(); ++k) {
        if (truth[k] == 0)
            continue; // mixed beyond recognition on the coarse mesh: no partner to judge by
        const double error = std::abs(cents(model.frequency[k], truth[k]));
        ++verdict.partials;
        verdict.bounded += error <= model.error_cents[k];
        if (error > 0.05) // below, the reference itself is in doubt
            verdict.ratio.push_back(model.error_cents[k] / error);
    }
}

double median(std::vector<double> v) {
    std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
    return v[v.size() / 2];
}

TEST(Band, BoundsTheTrueErrorOfNearlyAllPartials) {
    Verdict quadratic, cubic;
    for (const PitchCase& c : pitch_cases()) {
        if (c.name == "tube" || c.name == "sphere" || c.name == "clamped glass cup")
            continue; // long references: bench_pitch has them
        const TetMesh fine = refined(c.mesh);
        ModalOptions options = options_for(c, fine);
        options.max_modes += 6;
        options.max_frequency *= 1.1;
        options.verify = false;
        const ModalModel reference = solve_modes(fine, c.solids, options);
        judge(c, 2, reference, quadratic);
        judge(c, 3, reference, cubic);
    }
    RecordProperty("partials", cubic.partials);
    EXPECT_GT(quadratic.partials, 80);
    EXPECT_GT(cubic.partials, 80);
    EXPECT_GE(quadratic.bounded, 0.95 * quadratic.partials);
    EXPECT_GE(cubic.bounded, 0.95 * cubic.partials);
    EXPECT_LE(median(quadratic.ratio), 4);
    // Half the change must hold singular bodies too; smooth ones do better by far.
    EXPECT_LE(median(cubic.ratio), 20);
    std::printf("quadratic: %d of %d bounded, median band / error %.2f\n", quadratic.bounded,
                quadratic.partials, median(quadratic.ratio));
    std::printf("cubic:     %d of %d bounded, median band / error %.2f\n", cubic.bounded,
                cubic.partials, median(cubic.ratio));
}

} // namespace
} // namespace ode::soft
