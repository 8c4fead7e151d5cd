#include "source/radiation.h"

#include <array>
#include <numbers>

namespace ode::sound {
namespace {

constexpr std::array<std::string_view, 5> kNames = {"monopole", "rayleigh", "paper", "kirchhoff",
                                                    "transfer"};

} // namespace

std::string_view radiation_name(int i) noexcept {
    const auto at = static_cast<std::size_t>(i);
    return at < kNames.size() ? kNames[at] : std::string_view{};
}

bool find_radiation(std::string_view name, Radiation& radiation) noexcept {
    for (std::size_t i = 0; i < kNames.size(); ++i)
        if (kNames[i] == name) {
            radiation = static_cast<Radiation>(i);
            return true;
        }
    return false;
}

Facing radiation_facing(Radiation radiation) noexcept {
    switch (radiation) {
    case Radiation::kRayleigh:
        return Facing::kVisible;
    case Radiation::kPaper:
        return Facing::kCosine;
    case Radiation::kMonopole:
    case Radiation::kKirchhoff:
    case Radiation::kTransfer:
        break;
    }
    return Facing::kAll;
}

Leaning radiation_leaning(Radiation radiation) noexcept {
    switch (radiation) {
    case Radiation::kMonopole:
    case Radiation::kTransfer: // what has no modes
        return Leaning::kCarried;
    case Radiation::kKirchhoff:
        return Leaning::kNormal;
    case Radiation::kRayleigh:
    case Radiation::kPaper:
        break;
    }
    return Leaning::kNone;
}

bool radiation_differentiates(Radiation radiation) noexcept {
    return radiation != Radiation::kPaper;
}

double radiation_gain(Radiation radiation, const Air& air) noexcept {
    switch (radiation) {
    case Radiation::kRayleigh:
        return air.density / (2.0 * std::numbers::pi);
    case Radiation::kPaper:
        return air.density * air.speed; // P01 eq. 2; the unit of the result is Pa m
    case Radiation::kMonopole:
    case Radiation::kKirchhoff:
    case Radiation::kTransfer:
        break;
    }
    return air.density / (4.0 * std::numbers::pi);
}

} // namespace ode::sound
