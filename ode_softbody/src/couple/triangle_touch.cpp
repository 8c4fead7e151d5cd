#include "couple/triangle_touch.h"

#include <algorithm>

namespace ode::soft {
namespace {

std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }

} // namespace

Vec3 slip_at(const TriangleTouch& touch, const SurfaceNodes& surface, const NodeArray& velocity,
             const RigidMotion& motion) noexcept {
    Vec3 slip = motion.velocity_at(touch.at.point);
    const auto& corner = surface.triangle[index(touch.triangle)];
    for (int i = 0; i < 3; ++i)
        slip -= touch.at.weight[i] * velocity[index(corner[index(i)])];
    return slip;
}

double load_of(const TriangleTouch& touch, const TouchState& state, double damping, double dt,
               const RigidShadow& rigid) noexcept {
    return (state.stiffness * dt + 2 * damping) * dt *
           rigid.compliance(touch.at.point, state.normal);
}

bool push_triangle(const TriangleTouch& touch, TouchState& state, const ContactLaw& law,
                   double damping, double softening, const SurfaceNodes& surface,
                   const NodeArray& velocity, std::span<const double> inverse_mass, double dt,
                   RigidShadow& rigid, const NodeForces& force) noexcept {
    const auto& corner = surface.triangle[index(touch.triangle)];
    const Vec3& weight = touch.at.weight;
    const double k = softening * state.stiffness;
    const double c = softening * damping;
    Vec3 ahead = rigid.velocity_ahead(touch.at.point, dt);
    double compliance = rigid.compliance(touch.at.point, state.normal);
    for (int i = 0; i < 3; ++i) {
        const std::size_t n = index(corner[index(i)]);
        ahead -= weight[i] * (velocity[n] + dt * inverse_mass[n] * force[n]);
        compliance += weight[i] * weight[i] * inverse_mass[n];
    }
    const Vec3 slip = slip_at(touch, surface, velocity, rigid.motion());
    const double parting = slip.dot(state.normal);
    const double press = NormalContact{.stiffness = k,
                                       .damping = c,
                                       .compliance = compliance,
                                       .depth = touch.depth,
                                       .speed = -parting,
                                       .ahead = -ahead.dot(state.normal),
                                       .point = state.is_point ? &state.point : nullptr}
                             .press(dt);
    if (press == 0)
        return false;
    state.bears = true;
    const Vec3 across = slip - parting * state.normal;
    const double grip = law.friction * press;
    state.stretch += dt * across;
    state.stretch -= state.normal.dot(state.stretch) * state.normal;
    clamp_length(state.stretch, grip / (kTangential * k));
    Vec3 f = -kTangential * (k * state.stretch + c * across);
    clamp_length(f, grip);
    f += press * state.normal;
    for (int i = 0; i < 3; ++i)
        force.add(index(corner[index(i)]), -weight[i] * f);
    rigid.add({f, (touch.at.point - rigid.motion().pose.position).cross(f)});
    return true;
}

} // namespace ode::soft
