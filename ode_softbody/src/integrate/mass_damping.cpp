#include "integrate/mass_damping.h"

#include "integrate/rigid_fit.h"

#include <cmath>

namespace ode::soft {
namespace {

/// @param weight  mass of node i, or its share that counts.
template <class Weight, class Loss>
void damp(Weight weight, Loss loss, std::span<const double> inverse_mass, std::span<const int> held,
          NodeState& state) noexcept {
    const RigidMotions rigid(weight, inverse_mass, held, state.position);
    Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
    for (std::size_t i = 0; i < inverse_mass.size(); ++i)
        if (inverse_mass[i] != 0) {
            const Vec3 p = weight(i) * state.velocity[i];
            momentum += p;
            angular += (state.position[i] - rigid.pivot()).cross(p);
        }
    const RigidMotions::Motion motion = rigid.of(momentum, angular);
    for (std::size_t i = 0; i < inverse_mass.size(); ++i)
        if (inverse_mass[i] != 0)
            state.velocity[i] -=
                loss(i) * (state.velocity[i] - rigid.at(motion, state.position[i]));
}

} // namespace

void damp_deformation(std::span<const double> mass, std::span<const double> inverse_mass,
                      std::span<const int> held, std::span<const double> alpha, double dt,
                      NodeState& state) noexcept {
    if (alpha.size() == 1) {
        const double loss = -std::expm1(-alpha[0] * dt);
        damp([&](std::size_t i) { return mass[i]; }, [&](std::size_t) { return loss; },
             inverse_mass, held, state);
        return;
    }
    const auto loss = [&](std::size_t i) { return -std::expm1(-alpha[i] * dt); };
    damp([&](std::size_t i) { return mass[i] * loss(i); }, loss, inverse_mass, held, state);
}

} // namespace ode::soft
