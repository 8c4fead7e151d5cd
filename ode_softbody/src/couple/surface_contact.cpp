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

} // namespace ode::soft
