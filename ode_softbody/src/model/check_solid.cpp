#include "model/check_solid.h"

#include "base/error.h"

#include <cmath>
#include <limits>

namespace ode::soft {
namespace {

void require(bool holds, const char* what, double value, const char* cure) {
    if (!holds)
        throw InputError(format("the solid's %s is %g; %s", what, value, cure));
}

} // namespace

void check_solid(const Solid& s) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    require(s.young > 0 && s.young < kInfinity, "Young's modulus", s.young,
            "give a finite value above 0 in Pa (steel: 2e11)");
    require(s.density > 0 && s.density < kInfinity, "density", s.density,
            "give a finite value above 0 in kg/m^3 (steel: 7850)");
    require(s.poisson > -1 && s.poisson < 0.5, "Poisson ratio", s.poisson,
            "give a value above -1 and below 0.5; 0.49 for nearly incompressible rubber");
    const auto check_damping = [&](const char* what, double value, const char* unit) {
        require(value >= 0 && value < kInfinity, what, value, unit);
    };
    check_damping("viscosity phi", s.phi, "give a finite value of at least 0 in Pa s");
    check_damping("viscosity psi", s.psi, "give a finite value of at least 0 in Pa s");
    check_damping("damping alpha", s.alpha, "give a finite value of at least 0 in 1/s");
    check_damping("damping beta", s.beta, "give a finite value of at least 0 in s");
}

} // namespace ode::soft
