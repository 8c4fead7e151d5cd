#include "model/check_solid.h"

#include "base/error.h"

#include <cmath>

namespace ode::soft {

void check_solid(const Solid& s, const std::string& group) {
    const std::string whose = group.empty() ? "" : "of group '" + group + "' ";
    const auto require = [&](bool holds, const char* what, double value, const char* unit,
                             const char* cure) {
        if (!(holds && std::isfinite(value)))
            throw InputError(
                format("%s %sis %g%s: it must %s", what, whose.c_str(), value, unit, cure));
    };
    require(s.young > 0, "Young's modulus", s.young, " Pa", "be positive, such as 2e11 for steel");
    require(s.density > 0, "density", s.density, " kg/m^3", "be positive, such as 7850 for steel");
    require(s.poisson > -1 && s.poisson < 0.5, "Poisson's ratio", s.poisson, "",
            "lie between -1 and 0.5, both excluded; for rubber take 0.49");
    require(s.phi >= 0, "viscosity phi", s.phi, " Pa s", "not be negative");
    require(s.psi >= 0, "viscosity psi", s.psi, " Pa s", "not be negative");
    require(s.alpha >= 0, "damping alpha", s.alpha, " 1/s", "not be negative");
    require(s.beta >= 0, "damping beta", s.beta, " s", "not be negative");
    require(s.loss_factor >= 0 && s.loss_factor < 1, "loss factor", s.loss_factor, "",
            "lie between 0 and 1, such as 2e-4 for steel");
}

} // namespace ode::soft
