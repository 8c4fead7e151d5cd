// Forces of the points that touch.
#include "couple/surface_contact.h"

#include "couple/contact_law.h"

#include <array>
#include <cmath>

namespace ode::soft {
namespace {

std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }

/// Forces on the corners that have no sum and this couple: those of a rigid body of three equal
/// masses set spinning.
std::array<Vec3, 3> spread_couple(const std::array<Vec3, 3>& x, const Vec3& couple) noexcept {
    const Vec3 center = (x[0] + x[1] + x[2]) / 3;
    std::array<Vec3, 3> arm;
    Mat3 inertia = Mat3::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
        arm[i] = x[i] - center;
        inertia += arm[i].squaredNorm() * Mat3::Identity() - arm[i] * arm[i].transpose();
    }
    const Vec3 turn = inertia.inverse() * couple;
    for (Vec3& a : arm)
        a = turn.cross(a).eval();
    return arm;
}

} // namespace

void SurfaceContact::settle(const SoftSide& points, const SoftSide& faces, double dt) noexcept {
    for (Touch& touch : touch_) {
        State& state = state_[index(touch.point)];
        if (touch.spring == 0) {
            state.paid = 0;
            continue;
        }
        const auto& corner = faces_.nodes().triangle[index(touch.triangle)];
        Vec3 slip = points_.points()[index(touch.point)].in(points.velocity);
        for (int i = 0; i < 3; ++i)
            slip -= touch.at.weight[i] * faces.velocity[index(corner[index(i)])];
        state.paid -= touch.spring * dt * (slip + touch.slip).dot(touch.normal) / 2;
        state.paid = std::fmax(0, state.paid);
    }
}

void SurfaceContact::prepare(const SoftSide& points, const SoftSide& faces) noexcept {
    for (Touch& touch : touch_) {
        const SurfacePoint& point = points_.points()[index(touch.point)];
        const auto& corner = faces_.nodes().triangle[index(touch.triangle)];
        const double light = faces_.nodes().lightest[index(touch.triangle)];
        const double k = state_[index(touch.point)].stiffness;
        touch.damping =
            std::fmin(k * law_.damping, std::fmin(law_.bearable_point_damping * point.mass,
                                                  law_.bearable_face_damping * light));
        touch.press = 0;
        touch.spring = 0;
        touch.slip = point.in(points.velocity);
        touch.compliance = 0;
        for (std::size_t i = 0; i < 2; ++i)
            touch.compliance +=
                point.weight[i] * point.weight[i] * points.inverse_mass[index(point.node[i])];
        for (int i = 0; i < 3; ++i) {
            const std::size_t n = index(corner[index(i)]);
            touch.slip -= touch.at.weight[i] * faces.velocity[n];
            touch.compliance += touch.at.weight[i] * touch.at.weight[i] * faces.inverse_mass[n];
        }
    }
}

double SurfaceContact::press_of(Touch& touch, const State& state, double parting, double ahead,
                                double dt) noexcept {
    const double before = touch.depth + dt * parting;
    const double free = touch.depth - dt * ahead;
    const double g = dt * dt * touch.compliance;
    double spring = conserving_press(state.stiffness, g, before, free);
    if (g > 0) { // the substep's work, spring (free - g spring - before) / 2, leaves paid >= 0
        const double back = before - free;
        spring = std::fmin(spring, (std::sqrt(back * back + 8 * g * state.paid) - back) / (2 * g));
    }
    touch.spring = spring;
    if (spring == 0)
        return 0;
    const double mean_speed = (free - g * spring - before) / (2 * dt);
    const double c = touch.damping;
    return std::fmax(0, spring + c * mean_speed / (1 + dt * touch.compliance * c / 2));
}

double SurfaceContact::sweep(const SoftSide& points, const SoftSide& faces, double dt) noexcept {
    double change = 0;
    for (Touch& touch : touch_) {
        const Vec3& normal = state_[index(touch.point)].normal;
        const SurfacePoint& point = points_.points()[index(touch.point)];
        const auto& corner = faces_.nodes().triangle[index(touch.triangle)];
        Vec3 gain = Vec3::Zero(); // of speed by what acts so far, this contact included
        for (std::size_t i = 0; i < 2; ++i) {
            const std::size_t n = index(point.node[i]);
            gain += (point.weight[i] * points.inverse_mass[n]) * points.force[n];
        }
        for (int i = 0; i < 3; ++i) {
            const std::size_t n = index(corner[index(i)]);
            gain -= (touch.at.weight[i] * faces.inverse_mass[n]) * faces.force[n];
        }
        const double parting = touch.slip.dot(normal);
        const double others = gain.dot(normal) - touch.compliance * touch.press;
        const double press =
            press_of(touch, state_[index(touch.point)], parting, parting + dt * others, dt);
        const double more = press - touch.press;
        if (more == 0)
            continue;
        touch.press = press;
        change = std::fmax(change, std::fabs(more));
        apply(touch, more * normal, points, faces);
    }
    return change;
}

void SurfaceContact::apply(const Touch& touch, const Vec3& f, const SoftSide& points,
                           const SoftSide& faces) const noexcept {
    const SurfacePoint& point = points_.points()[index(touch.point)];
    const auto& corner = faces_.nodes().triangle[index(touch.triangle)];
    points.force.add(index(point.node[0]), point.weight[0] * f);
    if (point.weight[1] != 0)
        points.force.add(index(point.node[1]), point.weight[1] * f);
    for (int i = 0; i < 3; ++i)
        faces.force.add(index(corner[index(i)]), -touch.at.weight[i] * f);
}

std::size_t SurfaceContact::drag(const SoftSide& points, const SoftSide& faces,
                                 double dt) noexcept {
    std::size_t bearing = 0;
    for (const Touch& touch : touch_) {
        if (touch.press == 0)
            continue;
        ++bearing;
        State& state = state_[index(touch.point)];
        state.bears = true;
        if (law_.friction == 0)
            continue;
        const double k = kTangential * state.grip;
        const Vec3 across = touch.slip - touch.slip.dot(state.normal) * state.normal;
        const double most = law_.friction * touch.press;
        state.stretch += dt * across;
        state.stretch -= state.normal.dot(state.stretch) * state.normal;
        clamp_length(state.stretch, most / k);
        Vec3 f = -k * state.stretch - kTangential * touch.damping * across;
        clamp_length(f, most);
        apply(touch, f, points, faces);
        // Drag acts on the face at the closest point and on the other body at its own, deeper by
        // touch.depth: the couple that this makes is the face's to bear.
        const auto& corner = faces_.nodes().triangle[index(touch.triangle)];
        const std::array<Vec3, 3> x = {faces.position[index(corner[0])],
                                       faces.position[index(corner[1])],
                                       faces.position[index(corner[2])]};
        const Vec3 arm = points_.points()[index(touch.point)].in(points.position) - touch.at.point;
        const std::array<Vec3, 3> pair = spread_couple(x, -arm.cross(f));
        if (pair[0].allFinite() && pair[1].allFinite() && pair[2].allFinite())
            for (std::size_t i = 0; i < 3; ++i)
                faces.force.add(index(corner[i]), pair[i]);
    }
    return bearing;
}

} // namespace ode::soft
