#include "couple/sample_contact.h"

#include "couple/outward.h"
#include "couple/surface_elasticity.h"

#include <algorithm>
#include <limits>

namespace ode::soft {
namespace {

constexpr double kSpacing = 0.5;     ///< of samples, in mean edges
constexpr double kEntryDepth = 0.25; ///< of a sample first seen inside, in mean edges
// Samples share nodes: at half an edge apart on a line, about four press on a node's triangles.
// Node contacts take the other half of what the nodes can bear.
constexpr double kShare = 0.5 / 4;
// Triangles near a sample, in the mean over all samples: within half an edge lie about ten. A flat
// shape wholly in reach of a folded surface may need more, and grows once.
constexpr std::size_t kPairs = 16;

std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }

} // namespace

void SampleContact::begin_step(const RigidShape& shape, const ContactLaw& law, double dt) {
    const bool same = shape.kind == shape_.kind && shape.size == shape_.size;
    shape_ = shape;
    law_ = law;
    dt_ = dt;
    if (same)
        return;
    spacing_ = kSpacing * surface_.mean_edge;
    sample_ =
        surface_.triangle.empty() ? std::vector<RigidSample>{} : sample_shape(shape, spacing_);
    state_.assign(sample_.size(), State{});
    near_.clear();
    near_.reserve(sample_.size());
    touch_.clear();
    touch_.reserve(sample_.size());
    close_.reserve(surface_.triangle.size());
    pair_.reserve(kPairs * sample_.size());
}

void SampleContact::forget() noexcept {
    std::fill(state_.begin(), state_.end(), State{});
    touch_.clear();
}

void SampleContact::look(const NodeArray& position, const Pose& shape, double reach) {
    near_.clear();
    pair_.clear();
    close_.clear();
    Aabb around = Aabb::empty();
    for (const RigidSample& sample : sample_) {
        Aabb ball{shape.to_world(sample.center), shape.to_world(sample.center)};
        ball.grow(sample.radius + reach);
        around.include(ball);
    }
    for (std::size_t t = 0; t < surface_.triangle.size(); ++t) {
        Aabb box = Aabb::empty();
        for (const int n : surface_.triangle[t])
            box.include(position[index(n)]);
        if (around.overlaps(box))
            close_.push_back({static_cast<int>(t), box});
    }
    for (std::size_t s = 0; s < sample_.size(); ++s) {
        const Vec3 center = shape.to_world(sample_[s].center);
        const double most = sample_[s].radius + reach;
        const auto first = static_cast<int>(pair_.size());
        for (const Close& close : close_)
            if (close.box.distance2({center, center}) < most * most)
                pair_.push_back(close.triangle);
        const auto last = static_cast<int>(pair_.size());
        if (last > first)
            near_.push_back({static_cast<int>(s), first, last});
        else
            state_[s] = State{};
    }
}

void SampleContact::collect_nodes(std::vector<int>& out) const {
    for (const int t : pair_)
        out.insert(out.end(), surface_.triangle[index(t)].begin(),
                   surface_.triangle[index(t)].end());
}

double SampleContact::reach() const noexcept {
    double farthest = 0;
    for (const RigidSample& s : sample_)
        farthest = std::fmax(farthest, s.center.norm() + s.radius);
    return farthest;
}

void SampleContact::look_away() noexcept {
    if (!near_.empty())
        forget();
    near_.clear();
    touch_.clear();
}

SampleContact::Closest SampleContact::find_closest(const Near& near, const Vec3& center,
                                                   const State& state,
                                                   const NodeArray& position) const noexcept {
    Closest best;
    best.distance2 = std::numeric_limits<double>::infinity();
    for (int i = near.first; i < near.last; ++i) {
        const int triangle = pair_[index(i)];
        const auto& [a, b, c] = surface_.triangle[index(triangle)];
        const TrianglePoint at =
            closest_on_triangle(center, position[index(a)], position[index(b)], position[index(c)]);
        const double distance2 = (center - at.point).squaredNorm();
        if (distance2 >= best.distance2)
            continue;
        if (state.bears && area_vector(surface_, position, triangle).dot(state.normal) < 0)
            continue;
        best.triangle = triangle;
        best.at = at;
        best.distance2 = distance2;
    }
    return best;
}

double SampleContact::find_touching(const NodeArray& position, const NodeArray& velocity,
                                    const RigidShadow& rigid, const Pose& in_body, double dt,
                                    unsigned long& tests) noexcept {
    const Pose shape = in_body.in(rigid.motion().pose);
    double load = 0;
    touch_.clear();
    for (const Near& near : near_) {
        State& state = state_[index(near.sample)];
        const RigidSample& sample = sample_[index(near.sample)];
        const Vec3 center = shape.to_world(sample.center);
        const Closest closest = find_closest(near, center, state, position);
        tests += index(near.last - near.first);
        if (closest.triangle < 0) {
            state = State{};
            continue;
        }
        const Vec3 outward = pseudonormal(surface_, position, closest.triangle, closest.at.weight);
        const Vec3 away = center - closest.at.point;
        const bool outside = away.dot(outward) >= 0;
        const double distance = std::sqrt(closest.distance2);
        // Very near the surface the direction is lost in rounding; the feature still has one.
        const bool clear = distance > 1e-9 * surface_.mean_edge;
        const Vec3 normal =
            clear ? Vec3(away * ((outside ? 1 : -1) / distance)) : outward.normalized();
        const double whole = sample.radius - (outside ? distance : -distance);
        Touch touch{{closest.triangle, closest.at, whole, Vec3::Zero()}, near.sample};
        touch.slip = slip_at(touch, surface_, velocity, rigid.motion());
        const Vec3& slip = touch.slip;
        touch.depth -= state.overlap.hidden(whole, -slip.dot(normal), dt);
        const double depth = touch.depth;
        if (depth <= 0) {
            if (whole <= 0) {
                const EnergyBook book = state.book;
                state = State{};
                state.book = book;
                state.was_outside = true;
                state.overlap.hidden(0, 0, dt);
            }
            if (depth <= -kForesight * dt * slip.norm()) {
                state.book.close();
                continue;
            }
        }
        if (!state.bears && !state.was_outside && !(depth <= kEntryDepth * surface_.mean_edge))
            continue;
        const double light = kShare * surface_.lightest[index(closest.triangle)];
        const double bearable = kStiffnessShare / (dt_ * dt_) * light;
        const double wanted = law_.stiffness > 0 ? law_.stiffness * spacing_ * spacing_ : bearable;
        const double most = std::fmin(wanted, bearable);
        const double k =
            most / (1 + most * surface_.residual_at(closest.triangle, closest.at.weight));
        if (!state.bears) {
            state.stretch.setZero();
            state.stiffness = k;
            state.is_point = bears_by_point(surface_, law_) && shape_.kind == ShapeKind::sphere;
            if (state.is_point)
                state.point = point_spring(surface_, closest.triangle, closest.at.weight,
                                           1 / sample.radius, law_.rigid_compliance);
        }
        state.stiffness = std::fmin(state.stiffness, k); // never rises while it bears
        state.normal = normal;
        touch.damping = std::fmin(state.stiffness * law_.damping, kDampingShare * light / dt_);
        if (law_.friction > 0)
            load += grip_load(touch, state, dt, rigid);
        if (rigid.needs_books(dt))
            open_book(touch, state, dt);
        touch_.push_back(touch);
    }
    return load;
}

void SampleContact::sweep(const TouchForces& on, RigidResponse& rigid) noexcept {
    for (Touch& touch : touch_)
        sweep_triangle(touch, state_[index(touch.sample)], surface_, on, rigid);
}

void SampleContact::enter_books(const TouchForces& on, const RigidResponse& rigid) noexcept {
    for (const Touch& touch : touch_)
        enter_book(touch, state_[index(touch.sample)], surface_, on, rigid);
}

std::size_t SampleContact::drag(double softening, const TouchForces& on,
                                RigidShadow& rigid) noexcept {
    std::size_t bearing = 0;
    for (Touch& touch : touch_)
        bearing += drag_triangle(touch, state_[index(touch.sample)], law_.friction, softening,
                                 surface_, on, rigid);
    return bearing;
}

} // namespace ode::soft
