#include "couple/triangle_touch.h"

#include <algorithm>

namespace ode::soft {
namespace {

std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }

void share(const TriangleTouch& touch, const SurfaceNodes& surface, const Vec3& f,
           const NodeForces& force) noexcept {
    const auto& corner = surface.triangle[index(touch.triangle)];
    for (int i = 0; i < 3; ++i)
        force.add(index(corner[index(i)]), touch.at.weight[i] * f);
}

} // namespace

Vec3 slip_at(const TriangleTouch& touch, const SurfaceNodes& surface, const NodeArray& velocity,
             const RigidMotion& motion) noexcept {
    Vec3 slip = motion.velocity_at(touch.at.point);
    const auto& corner = surface.triangle[index(touch.triangle)];
    for (int i = 0; i < 3; ++i)
        slip -= touch.at.weight[i] * velocity[index(corner[index(i)])];
    return slip;
}

double grip_load(const TriangleTouch& touch, const TouchState& state, double dt,
                 const RigidShadow& rigid) noexcept {
    return kTangential * (state.stiffness * dt + 2 * touch.damping) * dt *
           rigid.grip_compliance(touch.at.point, state.normal);
}

void open_book(TriangleTouch& touch, TouchState& state, double dt) noexcept {
    touch.owed = state.book.open({.stiffness = state.stiffness,
                                  .damping = 0,
                                  .compliance = 0,
                                  .depth = touch.depth,
                                  .speed = -touch.slip.dot(state.normal),
                                  .ahead = 0,
                                  .point = state.is_point ? &state.point : nullptr},
                                 dt);
}

namespace {

/// The touched point after the kick.
Ahead ahead_of(const TriangleTouch& touch, const SurfaceNodes& surface, const TouchForces& on,
               const Vec3& direction) noexcept {
    const auto& corner = surface.triangle[index(touch.triangle)];
    if (const JointInertia* joint = on.force.joint()) {
        const CarriedPoint point{corner, touch.at.weight};
        return {joint->ahead(point), joint->compliance(point, direction)};
    }
    Ahead out{Vec3::Zero(), 0};
    for (int i = 0; i < 3; ++i) {
        const std::size_t n = index(corner[index(i)]);
        const double w = touch.at.weight[i];
        out.velocity += w * (on.velocity[n] + on.dt * on.inverse_mass[n] * on.force[n]);
        out.compliance += w * w * on.inverse_mass[n];
    }
    return out;
}

} // namespace

void sweep_triangle(TriangleTouch& touch, const TouchState& state, const SurfaceNodes& surface,
                    const TouchForces& on, RigidResponse& rigid) noexcept {
    const Ahead ahead = ahead_of(touch, surface, on, state.normal);
    const Vec3 slip = rigid.velocity_at(touch.at.point) - ahead.velocity;
    const Press press = NormalContact{.stiffness = state.stiffness,
                                      .damping = touch.damping,
                                      .compliance = ahead.compliance,
                                      .depth = touch.depth,
                                      .speed = -touch.slip.dot(state.normal),
                                      .ahead = -slip.dot(state.normal) +
                                               on.dt * ahead.compliance * touch.press.force,
                                      .point = state.is_point ? &state.point : nullptr,
                                      .owed = touch.owed}
                            .press(on.dt);
    rigid.add(touch.at.point, state.normal, press, touch.press.force);
    const double more = press.force - touch.press.force;
    touch.press = press;
    if (more != 0)
        share(touch, surface, -more * state.normal, on.force);
}

void enter_book(const TriangleTouch& touch, TouchState& state, const SurfaceNodes& surface,
                const TouchForces& on, const RigidResponse& rigid) noexcept {
    const Vec3 ahead =
        rigid.velocity_at(touch.at.point) - ahead_of(touch, surface, on, state.normal).velocity;
    state.book.enter(touch.press.spring, -on.dt * (touch.slip + ahead).dot(state.normal));
}

bool drag_triangle(TriangleTouch& touch, TouchState& state, double friction, double softening,
                   const SurfaceNodes& surface, const TouchForces& on,
                   RigidShadow& rigid) noexcept {
    if (touch.press.force == 0)
        return false;
    state.bears = true;
    if (friction == 0)
        return true;
    double k = kTangential * softening * state.stiffness;
    k /= 1 + k * surface.residual_across_at(touch.triangle, touch.at.weight);
    const double c = kTangential * softening * touch.damping;
    const Vec3 across = touch.slip - touch.slip.dot(state.normal) * state.normal;
    const double grip = friction * touch.press.force;
    state.stretch += on.dt * across;
    state.stretch -= state.normal.dot(state.stretch) * state.normal;
    clamp_length(state.stretch, grip / k);
    Vec3 f = -k * state.stretch - c * across;
    if (on.force.joint()) {
        // The substep is long for these springs: the force is the one at its end.
        const Vec3 along = (state.stretch + on.dt * across).stableNormalized();
        const Ahead ahead = ahead_of(touch, surface, on, along);
        Vec3 slip = rigid.motion().velocity_at(touch.at.point) - ahead.velocity;
        slip -= slip.dot(state.normal) * state.normal;
        f = -(k * (state.stretch + on.dt * slip) + c * slip) /
            (1 + ahead.compliance * on.dt * (k * on.dt + c));
    }
    clamp_length(f, grip);
    touch.grip = f;
    share(touch, surface, -f, on.force);
    rigid.add({f, (touch.at.point - rigid.motion().pose.position).cross(f)});
    return true;
}

} // namespace ode::soft
