#include "model/materials.h"

#include <array>

namespace ode::soft {
namespace {

// Elastic constants and Rayleigh damping, both of the same table.
constexpr const char* kWang =
    "constants and Rayleigh damping: Wang & James, KleinPAT (ACM Trans. Graph. 38, 2019), table 4";
constexpr const char* kPicard = "constants and Rayleigh damping: Picard et al. 2009, A robust and "
                                "multi-scale modal analysis for sound synthesis";

constexpr Solid rayleigh(double density, double young, double poisson, double alpha, double beta) {
    Solid s;
    s.young = young;
    s.poisson = poisson;
    s.density = density;
    s.alpha = alpha;
    s.beta = beta;
    return s;
}

// Metals lose much the same share of energy a cycle at all frequencies; published loss factors eta
// are: steel 0.2..3e-4, iron 1..4e-4, aluminium 3e-6..1e-4, brass 2e-4..1e-3, copper 2e-3 (Cremer &
// Heckl, Structure-Borne Sound, 2nd ed. 1988, as in Irvine, Damping Properties of
// Materials, 2004). beta = eta / w meets it (the geometric mean of a range) at 1 kHz: above, the
// preset rings shorter than metal, below longer. Who wants eta throughout gives loss_factor it.
constexpr const char* kCremer = "constants and loss factor: Cremer & Heckl 1988; beta "
                                "meets the loss factor at 1 kHz";
constexpr const char* kBronze =
    "phosphor bronze C51000: E and density of Olin Brass's data sheet (ASTM B103), nu of "
    "makeitfrom.com; no published damping found: that of brass, the nearest alloy in Cremer & "
    "Heckl 1988";
// nu as near to incompressible (0.4999) as elements of displacement bear; E = 3 G.
constexpr const char* kRubber =
    "vulcanised natural rubber: density 950, G 0.5 MPa of MatWeb; damping ratio 0.05 of Adams & "
    "Askenazi 1999 (in SolidWorks' help), met at 100 Hz and 1 kHz";

constexpr std::array kMaterials = {
    Material{"steel", rayleigh(7850, 200e9, 0.29, 5, 3e-8), kWang},
    Material{"iron", rayleigh(8000, 210e9, 0.28, 5, 1e-7), kWang},
    Material{"tin", rayleigh(7265, 50e9, 0.325, 2, 3e-8), kWang},
    Material{"aluminium", rayleigh(2700, 69e9, 0.33, 10, 3e-7), kPicard},
    Material{"ceramic", rayleigh(2700, 72e9, 0.19, 6, 1e-7), kWang},
    Material{"glass", rayleigh(2600, 62e9, 0.20, 1, 1e-7), kWang},
    Material{"wood", rayleigh(750, 11e9, 0.25, 60, 2e-6), kWang},
    Material{"plastic", rayleigh(1070, 1.4e9, 0.35, 30, 1e-6), kWang},
    Material{"brass", rayleigh(8500, 95e9, 0.33, 0, 7.1e-8), kCremer},
    Material{"bronze", rayleigh(8860, 110e9, 0.34, 0, 7.1e-8), kBronze},
    Material{"copper", rayleigh(8900, 125e9, 0.35, 0, 3.2e-7), kCremer},
    Material{"rubber", rayleigh(950, 1.5e6, 0.49, 57.1, 1.447e-5), kRubber},
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
