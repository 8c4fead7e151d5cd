#include "bench/time/error_vs_time.h"

#include "base/error.h"
#include "integrate/integrator.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {
namespace {

/// Explicit methods near the limit of central difference and a third of it; implicit ones, whose
/// steps cost tens of explicit ones, from there upwards.
constexpr double kExplicitShares[] = {0.9, 0.3};
constexpr double kImplicitShares[] = {1, 8, 64};

/// Ratio of run times that is no noise.
constexpr double kClearly = 1.15;

/// @param fine_steps  on the same elements; empty where that took too long
TimeRow judged(const TimeScene& scene, const Waveform& reference, const Waveform& fine_steps,
               const Method& method, double budget) {
    TimeRow row{scene.name, method, run(scene, method, budget)};
    if (row.run.within_budget && row.run.stable) {
        row.waveform = waveform_error(row.run.waveform, reference);
        if (!fine_steps.empty())
            row.steps = waveform_error(row.run.waveform, fine_steps);
        if (scene.closed_form()) {
            const RingingError ringing = ringing_error(scene, row.run.waveform);
            row.cents = ringing.cents;
            row.decay = ringing.decay;
        }
    }
    row.run.waveform.clear();
    return row;
}

void mark_front(std::span<TimeRow> rows) {
    for (TimeRow& row : rows)
        row.on_front =
            std::isfinite(row.waveform) &&
            std::none_of(rows.begin(), rows.end(), [&](const TimeRow& other) {
                return kClearly * other.run.cpu < row.run.cpu && other.waveform < row.waveform;
            });
}

} // namespace

std::vector<TimeRow> error_vs_time(double budget,
                                   const std::function<void(const std::string&)>& progress) {
    std::vector<TimeRow> rows;
    for (const TimeScene& scene : time_scenes()) {
        progress(scene.name + ", reference");
        const Waveform reference = reference_of(scene);
        const std::size_t first = rows.size();
        for (const int order : {1, 2}) {
            progress(format("%s, order %d, fine steps", scene.name.c_str(), order));
            const Waveform fine = run(scene, {"runge-kutta-4", order, 0.25}, 4 * budget).waveform;
            for (const IntegratorKind& kind : integrator_kinds())
                for (const double share : kind.implicit
                                              ? std::span<const double>(kImplicitShares)
                                              : std::span<const double>(kExplicitShares)) {
                    const Method method{std::string(kind.name), order, share};
                    progress(format("%s, order %d, %s, %g of the critical step", scene.name.c_str(),
                                    order, method.integrator.c_str(), share));
                    rows.push_back(judged(scene, reference, fine, method, budget));
                }
        }
        mark_front(std::span(rows).subspan(first));
    }
    return rows;
}

} // namespace ode::soft
