#include "integrate/integrator.h"

#include "base/error.h"
#include "integrate/central_difference.h"

#include <array>
#include <string>

namespace ode::soft {
namespace {

constexpr std::array<std::string_view, 1> kNames = {"central_difference"};

} // namespace

std::span<const std::string_view> integrator_names() noexcept { return kNames; }

std::unique_ptr<Integrator> make_integrator(std::string_view name, std::size_t) {
    if (name == "central_difference")
        return std::make_unique<CentralDifference>();
    std::string known;
    for (const std::string_view n : kNames)
        known += (known.empty() ? "" : ", ") + std::string(n);
    throw InputError(format("integrator '%s' is unknown: choose one of %s",
                            std::string(name).c_str(), known.c_str()));
}

} // namespace ode::soft
