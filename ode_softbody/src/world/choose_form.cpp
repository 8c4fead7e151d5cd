#include "world/choose_form.h"

#include "base/error.h"
#include "integrate/modal_response.h"
#include "mesh/promote.h"
#include "modal/cache.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ode::soft {
namespace {

/// A quadratic element's force in those of a linear one (bench_force: 55 to 4.8 ns).
constexpr double kQuadraticCost = 12;
constexpr double kStepShare = 0.9; ///< of the critical one, as by default
/// Below this speed of sound [m/s] a fall from a metre strains a body by some 5 % or more, where
/// St. Venant-Kirchhoff gives way under compression.
constexpr double kSoft = 90;

double cents_between(double a, double b) { return 1200 * std::abs(std::log2(a / b)); }

ModalModel partials_of(const Body& body, int order, bool lumped) {
    ModalOptions options;
    options.order = order;
    options.mass = lumped ? MassKind::kLumped : MassKind::kConsistent;
    options.estimate = !lumped;
    options.max_modes = kChosenPartials;
    options.max_frequency = 1e7;
    options.clamped.assign(body.pinned().begin(), body.pinned().end());
    ModalModel out = cached_modes(body.mesh(), body.solids(), options, cache_directory());
    if (out.mode_count() == 0)
        throw InputError("the body has no vibration modes to be right about");
    return out;
}

/// Off the truth by elements [cents].
double element_error(const ModalModel& stepped, const ModalModel& truth) {
    double worst = 0;
    for (std::size_t k = 0; k < std::min(stepped.mode_count(), truth.mode_count()); ++k)
        worst = std::max(worst, cents_between(stepped.frequency[k], truth.frequency[k]) +
                                    truth.error_cents[k]);
    return worst;
}

/// Off by steps of h [cents].
double step_error(ModalAnalysis& method, const ModalModel& partials, double h) {
    double worst = 0;
    for (const double f : partials.frequency) {
        const double error = method.response(2 * std::numbers::pi * f * h, 0).period_error;
        worst = std::max(worst, std::isfinite(error) ? cents_between(1 + error, 1)
                                                     : std::numeric_limits<double>::infinity());
    }
    return worst;
}

const char* model_for(std::span<const Solid> solids) {
    double slowest = std::numeric_limits<double>::infinity();
    for (const Solid& solid : solids)
        slowest = std::min(slowest, std::sqrt(solid.young / solid.density));
    return slowest < kSoft ? "stable-neo-hookean" : "stvk";
}

/// The explicit methods on elements of the body's present order, into `best`.
void look_at_methods(Body& body, double element_cents, const ModalModel& partials, double cents,
                     std::vector<FormChoice>& found) {
    for (const IntegratorKind& kind : integrator_kinds()) {
        if (kind.implicit)
            continue;
        BodyForm form = body.form();
        form.integrator = kind.name;
        body.set_form(form);
        if (!(body.critical_step() > 0))
            continue;
        ModalAnalysis method(kind.name);
        double h = kStepShare * body.critical_step();
        double off = step_error(method, partials, h);
        for (int halvings = 0; element_cents + off > cents && element_cents < cents && halvings < 6;
             ++halvings) {
            h /= 2;
            off = step_error(method, partials, h);
        }
        const double elements = static_cast<double>(body.mesh().element_count()) *
                                (body.form().order == 2 ? kQuadraticCost : 1);
        found.push_back({body.form(), h, element_cents + off, elements * kind.forces / h});
    }
}

} // namespace

FormChoice choose_form(Body& body, double cents) {
    const BodyForm before = body.form();
    const double substep_before = body.substep();
    try {
        const int lowest = body.given_order();
        std::vector<FormChoice> found;
        BodyForm form = before;
        form.model = model_for(body.solids());
        form.order = 2;
        body.set_form(form);
        const ModalModel truth = partials_of(body, 3, false);
        for (const int order : {1, 2}) {
            if (order < lowest || (order == 1 && before.curved))
                continue;
            form.order = order;
            body.set_form(form);
            const ModalModel stepped = partials_of(body, order, true);
            look_at_methods(body, element_error(stepped, truth), stepped, cents, found);
        }
        const auto is_right = [&](const FormChoice& c) { return c.expected_cents <= cents; };
        const bool any = std::any_of(found.begin(), found.end(), is_right);
        const auto best = std::min_element(
            found.begin(), found.end(), [&](const FormChoice& a, const FormChoice& b) {
                if (any && is_right(a) != is_right(b))
                    return is_right(a);
                return any ? a.forces < b.forces : a.expected_cents < b.expected_cents;
            });
        const FormChoice choice = *best;
        body.set_form(choice.form);
        body.set_substep(choice.substep);
        return choice;
    } catch (...) {
        if (body.form().order != before.order || body.form().model != before.model ||
            body.form().integrator != before.integrator) {
            body.set_form(before);
            body.set_substep(substep_before);
        }
        throw;
    }
}

} // namespace ode::soft
