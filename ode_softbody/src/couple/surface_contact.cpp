#include "couple/surface_contact.h"

#include "couple/outward.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ode::soft {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kEntryDepth = 0.25; ///< of a point first seen inside, in mean edges
constexpr double kSameSide = 0.5;    ///< cosine: a face turned by less than 60 degrees
constexpr double kFlush = 0.002;     ///< within a side, in mean edges, that it isn't the way out
constexpr double kSlip = 0.02;       ///< beside a body, in mean edges, before a point is let go
// Nearer than this, in mean edges, the direction between two points is rounding.
constexpr double kClear = 1e-11;

std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }

TrianglePoint closest_point(const Vec3& x, const std::array<int, 3>& corner,
                            const NodeArray& position) noexcept {
    return closest_on_triangle(x, position[index(corner[0])], position[index(corner[1])],
                               position[index(corner[2])]);
}

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

SurfaceContact::SurfaceContact(const SoftSurface& points, const SoftSurface& faces, bool self)
    : points_(points), faces_(faces), self_(self), state_(points.points().size()) {
    near_.reserve(state_.size());
    touch_.reserve(state_.size());
    kept_touch_.reserve(state_.size());
    found_.reserve(64);
    face_.reserve(16 * state_.size());
}

bool SurfaceContact::are_neighbours(int point, int triangle) const noexcept {
    const SurfacePoint& p = points_.points()[index(point)];
    const auto rest = faces_.rest();
    const auto& [a, b, c] = faces_.nodes().triangle[index(triangle)];
    const Vec3 x = p.weight[0] * rest[index(p.node[0])] + p.weight[1] * rest[index(p.node[1])];
    const Vec3 at = closest_on_triangle(x, rest[index(a)], rest[index(b)], rest[index(c)]).point;
    const double edge = faces_.nodes().mean_edge;
    return (x - at).squaredNorm() < edge * edge;
}

double SurfaceContact::cosine_with(const Vec3& normal, int triangle,
                                   const NodeArray& position) const noexcept {
    const Vec3 area = area_vector(faces_.nodes(), position, triangle);
    return area.dot(normal) / area.norm();
}

bool SurfaceContact::flush_with(const Closest& facing, const Closest& front) const noexcept {
    const double edge = faces_.nodes().mean_edge;
    return front.triangle >= 0 && facing.distance2 < kFlush * kFlush * edge * edge;
}

bool SurfaceContact::has_slipped_off(const Closest& closest, const Vec3& x, const State& state,
                                     const NodeArray& position) const noexcept {
    const Vec3 away = x - closest.at.point;
    const double edge = faces_.nodes().mean_edge;
    return closest.distance2 > kSlip * kSlip * edge * edge &&
           away.dot(state.normal) > -kSameSide * std::sqrt(closest.distance2) &&
           away.dot(pseudonormal(faces_.nodes(), position, closest.triangle, closest.at.weight)) >
               0;
}

double SurfaceContact::look(const SoftSide& points, const SoftSide& faces, double reach,
                            double slack, unsigned long& tests) {
    near_.clear();
    face_.clear();
    double nearest = kInfinity;
    for (std::size_t s = 0; s < state_.size(); ++s) {
        State& state = state_[s];
        const Vec3 x = points_.points()[s].in(points.position);
        found_.clear();
        double closest = kInfinity;
        double facing = kInfinity;
        // Whatever is within 2 slack of the closest triangle may become the closest.
        const double range = reach + 2 * slack + (state.bears ? std::fmax(0.0, state.depth) : 0);
        const double beyond = faces_.tree().near({x, x}, range, [&](int t) {
            if (self_ && are_neighbours(static_cast<int>(s), t))
                return;
            const Vec3 at =
                closest_point(x, faces_.nodes().triangle[index(t)], faces.position).point;
            const double distance = (x - at).norm();
            closest = std::fmin(closest, distance);
            if (state.bears && cosine_with(state.normal, t, faces.position) >= 0)
                facing = std::fmin(facing, distance);
            found_.push_back({t, distance});
        });
        tests += found_.size();
        nearest = std::fmin(nearest, beyond);
        if (!(closest < reach) && !(facing < range)) {
            nearest = std::fmin(nearest, closest);
            if (state.bears || state.was_outside) // far ones are many
                state = State{};
            continue;
        }
        const double most = (facing < range ? std::fmax(closest, facing) : closest) + 2 * slack;
        const auto first = static_cast<int>(face_.size());
        for (const Found& f : found_)
            if (f.distance <= most)
                face_.push_back(f.triangle);
        near_.push_back({static_cast<int>(s), first, static_cast<int>(face_.size()), 0});
    }
    return nearest;
}

void SurfaceContact::look_away() noexcept {
    if (near_.empty())
        return;
    near_.clear();
    touch_.clear();
    std::fill(state_.begin(), state_.end(), State{});
}

void SurfaceContact::find_closest(const Near& near, const Vec3& x, const State& state,
                                  const NodeArray& position, Closest& any, Closest& facing,
                                  Closest& front) const noexcept {
    for (int i = near.first; i < near.last; ++i) {
        const int t = face_[index(i)];
        const TrianglePoint at = closest_point(x, faces_.nodes().triangle[index(t)], position);
        const double distance2 = (x - at.point).squaredNorm();
        if (distance2 < any.distance2)
            any = {t, at, distance2};
        if (!state.bears)
            continue;
        const double turn = cosine_with(state.normal, t, position);
        if (turn >= 0 && distance2 < facing.distance2)
            facing = {t, at, distance2};
        if (turn >= kSameSide && distance2 < front.distance2)
            front = {t, at, distance2};
    }
}

void SurfaceContact::find_touching(const SoftSide& points, const SoftSide& faces, double way,
                                   double dt, unsigned long& tests) noexcept {
    const double edge = faces_.nodes().mean_edge;
    touch_.clear();
    for (Near& near : near_) {
        if (way < near.wake)
            continue;
        State& state = state_[index(near.point)];
        const SurfacePoint& point = points_.points()[index(near.point)];
        const Vec3 x = point.in(points.position);
        Closest closest;
        Closest facing;
        Closest front;
        find_closest(near, x, state, faces.position, closest, facing, front);
        tests += index(near.last - near.first);
        if (closest.triangle < 0 || (state.bears && facing.triangle < 0)) {
            state = State{};
            continue;
        }
        const bool chosen = state.bears && !has_slipped_off(closest, x, state, faces.position);
        const bool flush = chosen && flush_with(facing, front);
        if (chosen)
            closest = flush ? front : facing;
        const auto& corner = faces_.nodes().triangle[index(closest.triangle)];
        const Vec3& weight = closest.at.weight;
        const Vec3 outward = pseudonormal(faces_.nodes(), faces.position, closest.triangle, weight);
        const Vec3 away = x - closest.at.point;
        const bool outside = away.dot(flush ? state.normal : outward) >= 0;
        const double distance = std::sqrt(closest.distance2);
        const double depth = outside ? -distance : distance;
        if (depth <= 0) {
            const double paid = state.paid;
            state = State{};
            state.paid = paid;
            state.was_outside = true;
            Vec3 slip = point.in(points.velocity);
            for (int i = 0; i < 3; ++i)
                slip -= weight[i] * faces.velocity[index(corner[index(i)])];
            const double ahead = kForesight * dt * slip.norm();
            if (distance >= ahead) {
                near.wake = way + distance - ahead;
                continue;
            }
        }
        const bool found_inside = !state.bears && !state.was_outside;
        if (found_inside && !(depth <= kEntryDepth * edge))
            continue;
        const double bearable =
            std::fmin(law_.bearable_point * point.mass,
                      law_.bearable_face * faces_.nodes().lightest[index(closest.triangle)]);
        const double k = std::fmin(law_.stiffness * point.area, law_.hardness * bearable);
        state.stiffness = state.bears ? std::fmin(state.stiffness, k) : k;
        state.grip = std::fmin(state.stiffness, bearable);
        state.normal = distance > kClear * edge ? Vec3(away * ((outside ? 1 : -1) / distance))
                                                : outward.stableNormalized();
        state.depth = depth;
        if (found_inside)
            state.paid = state.stiffness * depth * depth / 2;
        touch_.push_back({near.point, closest.triangle, closest.at, depth, 0, 0, 0, 0, Vec3::Zero(),
                          state.normal});
    }
}

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
