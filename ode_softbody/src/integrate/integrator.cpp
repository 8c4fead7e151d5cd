#include "integrate/integrator.h"

#include "base/error.h"
#include "integrate/backward_euler.h"
#include "integrate/central_difference.h"
#include "integrate/explicit_euler.h"
#include "integrate/linearised_backward_euler.h"
#include "integrate/midpoint.h"
#include "integrate/modified_euler.h"
#include "integrate/runge_kutta_4.h"
#include "integrate/symplectic_euler.h"
#include "integrate/tr_bdf2.h"
#include "integrate/trapezoidal.h"

#include <algorithm>
#include <string>

namespace ode::soft {
namespace {

template <class Method>
std::unique_ptr<Integrator> make(std::size_t nodes) {
    if constexpr (std::is_constructible_v<Method, std::size_t>)
        return std::make_unique<Method>(nodes);
    else
        return std::make_unique<Method>();
}

constexpr IntegratorKind kKinds[] = {
    {"central-difference", 2, false, true, 1, make<CentralDifference>},
    {"explicit-euler", 1, false, false, 1, make<ExplicitEuler>},
    {"symplectic-euler", 1, false, true, 1, make<SymplecticEuler>},
    {"modified-euler", 2, false, false, 2, make<ModifiedEuler>},
    {"midpoint", 2, false, false, 2, make<Midpoint>},
    {"runge-kutta-4", 4, false, false, 4, make<RungeKutta4>},
    {"backward-euler", 1, true, false, 1, make<BackwardEuler>},
    {"linearised-backward-euler", 1, true, false, 1, make<LinearisedBackwardEuler>},
    {"trapezoidal", 2, true, false, 1, make<Trapezoidal>},
    {"tr-bdf2", 2, true, false, 2, make<TrBdf2>},
};

} // namespace

std::span<const IntegratorKind> integrator_kinds() noexcept { return kKinds; }

const IntegratorKind& integrator_kind(std::string_view name) {
    if (name == "verlet")
        name = "central-difference";
    const auto found = std::find_if(std::begin(kKinds), std::end(kKinds),
                                    [&](const IntegratorKind& k) { return k.name == name; });
    if (found != std::end(kKinds))
        return *found;
    std::string known;
    for (const IntegratorKind& k : kKinds)
        known += (known.empty() ? "" : ", ") + std::string(k.name);
    throw InputError(format("integrator '%s' is unknown: choose one of %s",
                            std::string(name).c_str(), known.c_str()));
}

} // namespace ode::soft
