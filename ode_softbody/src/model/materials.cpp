#include "model/materials.h"

#include <array>

namespace ode::soft {
namespace {

// Wang & James 2019 (doi:10.1145/3306346.3323039), table 4: elastic constants and Rayleigh damping.
constexpr const char* kWang = "Wang & James 2019, table 4";

constexpr Solid rayleigh(double density, double young, double poisson, double alpha, double beta) {
    Solid s;
    s.young = young;
    s.poisson = poisson;
    s.density = density;
    s.alpha = alpha;
    s.beta = beta;
    return s;
}

// Loss factors of Cremer & Heckl (Structure-Borne Sound) lie at 2e-4 to 1e-3 for brass and 2e-3 for
// copper, much the same at all frequencies. beta = eta / w meets the (geometric) mean at 1 kHz;
// above, the preset rings shorter than metal, below longer.
constexpr const char* kCremer =
    "elastic constants and loss factor of Cremer & Heckl; beta meets the loss factor at 1 kHz";
constexpr const char* kBronze =
    "elastic constants of UNS C51000, handbook values (ASM Handbook 2); "
    "no sourced damping: beta chosen for T60 5 s at 1 kHz";
constexpr const char* kRubber =
    "natural rubber, unfilled, handbook values (Ashby, Materials Selection); "
    "no sourced damping: chosen for T60 0.22 s at 100 Hz and 0.03 s at 1 kHz";

constexpr std::array kMaterials = {
    Material{"steel", rayleigh(7850, 200e9, 0.29, 5, 3e-8), kWang},
    Material{"iron", rayleigh(8000, 210e9, 0.28, 5, 1e-7), kWang},
    Material{"tin", rayleigh(7265, 50e9, 0.325, 2, 3e-8), kWang},
    Material{"aluminium", rayleigh(2700, 69e9, 0.33, 10, 3e-7), "Picard et al. 2009"},
    Material{"ceramic", rayleigh(2700, 72e9, 0.19, 6, 1e-7), kWang},
    Material{"glass", rayleigh(2600, 62e9, 0.20, 1, 1e-7), kWang},
    Material{"wood", rayleigh(750, 11e9, 0.25, 60, 2e-6), kWang},
    Material{"plastic", rayleigh(1070, 1.4e9, 0.35, 30, 1e-6), kWang},
    Material{"brass", rayleigh(8500, 95e9, 0.33, 0, 7.1e-8), kCremer},
    Material{"bronze", rayleigh(8860, 110e9, 0.34, 0, 7e-8), kBronze},
    Material{"copper", rayleigh(8900, 125e9, 0.35, 0, 3.2e-7), kCremer},
    Material{"rubber", rayleigh(930, 2e6, 0.49, 60, 1e-5), kRubber},
    Material{"polycarbonate", rayleigh(1190, 2.4e9, 0.37, 0.5, 4e-7), kWang},
};

} // namespace

std::span<const Material> materials() noexcept { return kMaterials; }

const Material* find_material(std::string_view name) noexcept {
    for (const Material& m : kMaterials)
        if (name == m.name)
            return &m;
    return nullptr;
}

} // namespace ode::soft
