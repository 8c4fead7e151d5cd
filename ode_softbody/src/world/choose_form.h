#pragma once

#include "world/body.h"

namespace ode::soft {

/// What a body is to be solved as, and how far its pitch is then expected to be off.
struct FormChoice {
    BodyForm form;
    double substep;        ///< [s]
    double expected_cents; ///< of the worst of its lowest partials: elements and steps together
    double forces;         ///< element forces a simulated second, in those of linear elements
};

/// Partials that the tolerance is for.
inline constexpr std::size_t kChosenPartials = 8;

/// The cheapest way to step a body of which the lowest partials are right to `cents`; the truest
/// there is where none is. The body gets that form and substep.
///
/// Elements err by what the modes of their lumped, stepped matrices miss of the corrected cubic
/// ones on the same mesh, mode by mode in order, and by the band of these; the integrator by its
/// period error at each partial, read off its code (ModalAnalysis). Only explicit methods are
/// looked at: a solve costs 100 (linear) to 500 (quadratic) force evaluations, and the step that
/// keeps eight partials to a few cents is no more than ten times the explicit one
/// (`softsound bench error-vs-time`). Geometry is the body's own: facets, unless it is curved.
/// @param cents  > 0
/// @throws InputError when the body has been stepped or has no modes; then nothing is changed
FormChoice choose_form(Body& body, double cents);

} // namespace ode::soft
