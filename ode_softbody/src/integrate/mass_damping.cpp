#include "integrate/mass_damping.h"

#include <cmath>

namespace ode::soft {
namespace {

struct RigidFit {
    Vec3 center = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
    Vec3 spin = Vec3::Zero();

    Vec3 at(const Vec3& x) const noexcept { return velocity + spin.cross(x - center); }
};

/// The rigid motion with the linear and angular momentum of the free nodes.
RigidFit fit(std::span<const double> mass, std::span<const double> inverse_mass,
             const NodeState& state) noexcept {
    RigidFit rigid;
    double total = 0;
    for (std::size_t i = 0; i < mass.size(); ++i) {
        if (inverse_mass[i] == 0)
            continue;
        total += mass[i];
        rigid.center += mass[i] * state.position[i];
        rigid.velocity += mass[i] * state.velocity[i];
    }
    rigid.center /= total;
    rigid.velocity /= total;
    Mat3 inertia = Mat3::Zero();
    Vec3 momentum = Vec3::Zero();
    for (std::size_t i = 0; i < mass.size(); ++i) {
        if (inverse_mass[i] == 0)
            continue;
        const Vec3 r = state.position[i] - rigid.center;
        inertia += mass[i] * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
        momentum += mass[i] * r.cross(state.velocity[i]);
    }
    rigid.spin = inertia.ldlt().solve(momentum);
    return rigid;
}

} // namespace

void damp_deformation(std::span<const double> mass, std::span<const double> inverse_mass,
                      std::size_t held, double alpha, double dt, NodeState& state) noexcept {
    const RigidFit rigid = held < 3 ? fit(mass, inverse_mass, state) : RigidFit{};
    const double loss = -std::expm1(-alpha * dt);
    for (std::size_t i = 0; i < mass.size(); ++i)
        if (inverse_mass[i] != 0)
            state.velocity[i] -= loss * (state.velocity[i] - rigid.at(state.position[i]));
}

} // namespace ode::soft
