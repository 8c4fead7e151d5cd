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

/// The rigid motion with the linear and angular momentum of the free nodes, each of the mass
/// weight(i).
template <class Weight>
RigidFit fit(Weight weight, std::span<const double> inverse_mass, const NodeState& state) noexcept {
    RigidFit rigid;
    double total = 0;
    for (std::size_t i = 0; i < inverse_mass.size(); ++i) {
        if (inverse_mass[i] == 0)
            continue;
        const double m = weight(i);
        total += m;
        rigid.center += m * state.position[i];
        rigid.velocity += m * state.velocity[i];
    }
    if (total == 0)
        return rigid; // only held nodes would lose anything
    rigid.center /= total;
    rigid.velocity /= total;
    Mat3 inertia = Mat3::Zero();
    Vec3 momentum = Vec3::Zero();
    for (std::size_t i = 0; i < inverse_mass.size(); ++i) {
        if (inverse_mass[i] == 0)
            continue;
        const Vec3 r = state.position[i] - rigid.center;
        const double m = weight(i);
        inertia += m * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
        momentum += m * r.cross(state.velocity[i]);
    }
    rigid.spin = inertia.ldlt().solve(momentum);
    return rigid;
}

} // namespace

void damp_deformation(std::span<const double> mass, std::span<const double> inverse_mass,
                      std::size_t held, std::span<const double> alpha, double dt,
                      NodeState& state) noexcept {
    const double uniform = -std::expm1(-alpha[0] * dt);
    const bool by_node = alpha.size() > 1;
    const auto loss = [&](std::size_t i) {
        return by_node ? -std::expm1(-alpha[i] * dt) : uniform;
    };
    RigidFit rigid;
    if (held < 3)
        rigid = by_node ? fit([&](std::size_t i) { return mass[i] * loss(i); }, inverse_mass, state)
                        : fit([&](std::size_t i) { return mass[i]; }, inverse_mass, state);
    for (std::size_t i = 0; i < mass.size(); ++i)
        if (inverse_mass[i] != 0)
            state.velocity[i] -= loss(i) * (state.velocity[i] - rigid.at(state.position[i]));
}

} // namespace ode::soft
