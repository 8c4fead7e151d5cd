// Which nodes, samples and poles a substep has to look at, and for how long that holds.
#include "couple/free_flight.h"
#include "couple/node_contact.h"
#include "couple/outward.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace ode::soft {
namespace {

// How far nodes may get before they are looked at anew: elastic waves may make them kHaste times
// as fast as the fastest is now, free bodies may accelerate by kAcceleration.
constexpr double kHaste = 4;
constexpr double kAcceleration = 1000; ///< [m/s^2]
// Of a node by itself within the horizon: what the body's frame makes it.
constexpr double kTurning = 2;
// Nodes that take more horizons to get near are left out of looks for as long.
constexpr double kWide = 10;
// A blow is over when some looks have seen none.
constexpr double kFading = 0.8;

std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }

/// Unit vector into the soft body at a surface node; zero for a node without triangles.
Vec3 inward_at(const SurfaceNodes& surface, const NodeArray& position, std::size_t i) noexcept {
    Vec3 sum = Vec3::Zero();
    if (!surface.triangle.empty())
        for (const int t : surface.fan(surface.node[i]))
            sum -= area_vector(surface, position, t);
    return sum.stableNormalized();
}

} // namespace

void NodeContact::find_candidates(const NodeArray& position, const NodeArray& velocity,
                                  const RigidMotion& motion) noexcept {
    const Pose pose = shape_.pose.in(motion.pose);
    const double reach = kReach * nodes_.mean_edge;
    double nearest = std::numeric_limits<double>::infinity(); // of those left out
    double closest = nearest;                                 // of all
    double fastest2 = 0;
    candidate_.clear();
    for (std::size_t i = 0; i < nodes_.node.size(); ++i) {
        const auto x = position[index(nodes_.node[i])];
        const Vec3 slip = velocity[index(nodes_.node[i])] - motion.velocity_at(x);
        fastest2 = std::fmax(fastest2, slip.squaredNorm());
        const double distance = shape_.distance(pose.to_local(x)).distance;
        closest = std::fmin(closest, distance);
        if (distance < reach)
            candidate_.push_back(static_cast<int>(i));
        else
            nearest = std::fmin(nearest, distance);
    }
    find_points(position, pose, closest < reach + 2 * nodes_.mean_edge, reach);
    if (samples_.exist())
        nearest = std::fmin(nearest, reach); // as far as they may slide
    look_again_in_ = time_to_cross(nearest, kHaste * (std::sqrt(fastest2) + sweeping(motion)));
}

void NodeContact::find_candidates(const NodeArray& position, const NodeArray& velocity,
                                  const RigidShadow& rigid, RoughPlaces& rough) noexcept {
    const RigidMotion& motion = rigid.motion();
    const Pose pose = shape_.pose.in(motion.pose);
    const double most = kReach * nodes_.mean_edge;
    const std::span<const NodeGroups::Group> groups = rough.groups().groups();
    constexpr double kNever = std::numeric_limits<double>::infinity();
    if (look_wide_in_ <= 0 || samples_.exist()) {
        wide_.resize(groups.size());
        std::iota(wide_.begin(), wide_.end(), 0);
        look_wide_in_ = wide_free_in_ = kNever;
    }
    for (std::size_t i = 0; samples_.exist() && i < nodes_.node.size(); ++i)
        rough.carry(nodes_.node[i]);
    double closest = kNever;
    double fastest = 0;
    look_again_in_ = quiet_in_ = free_in_ = kNever;
    candidate_.clear();
    closing_ *= kFading;
    const auto see = [&](const Vec3& x) {
        const SurfaceDistance there = shape_.distance(pose.to_local(x));
        const Vec3 normal = pose.rotation * there.normal;
        const Vec3 slip = rough.frame().velocity_at(x) - motion.velocity_at(x);
        return Seen{there.distance, -slip.dot(normal), slip.norm(), normal};
    };
    const double spin = (rough.frame().spin - motion.spin).norm();
    const double highest = recess_.empty() ? 0 : nodes_.shape.highest;
    // What strikes may turn the body, so that others come as fast.
    double striking = closing_;
    seen_.resize(groups.size());
    for (const int g : wide_) {
        const NodeGroups::Group& group = groups[index(g)];
        const Seen& carried = seen_[index(g)] = see(rough.frame().pose.to_world(group.center));
        fastest = std::fmax(fastest, carried.speed + group.radius * spin);
        if (carried.distance - group.radius - highest - rough.off() < most)
            striking = std::fmax(striking, carried.closing + group.radius * spin);
    }
    const double haste = kHaste * rough.speed() + kTurning * striking;
    const double reach = std::fmin(most, horizon_ * (haste + kAcceleration / 2 * horizon_));
    // From a convex shape that stands still, the distance grows at least as along the normal.
    const bool stands = rigid.role() == RigidRole::fixed;
    const auto look_at = [&](int i) {
        const int node = nodes_.node[index(i)];
        const Seen carried = see(rough.carried(node));
        // A bulge may touch before its node does.
        const double stands_out = has_pole(index(i)) ? nodes_.shape.highest : 0;
        double gap = carried.distance - stands_out - rough.off();
        closest = std::fmin(closest, gap);
        if (gap >= reach) {
            const double time = time_to_cross(gap, haste);
            quiet_in_ = std::fmin(quiet_in_, time);
            look_again_in_ = std::fmin(look_again_in_, time);
            if (stands && free_in_ > 0)
                free_in_ =
                    std::fmin(free_in_, time_to_fall(gap, carried.closing, rough.acceleration()));
            return;
        }
        rough.place(node);
        const auto x = position[index(node)];
        const SurfaceDistance there = shape_.distance(pose.to_local(x));
        const Vec3 slip = velocity[index(node)] - motion.velocity_at(x);
        const double closing = -slip.dot(pose.rotation * there.normal);
        gap = there.distance - stands_out;
        quiet_in_ = std::fmin(quiet_in_, std::fmax(0.0, time_to_cross(gap, haste)));
        candidate_.push_back(i);
        closing_ = std::fmax(closing_, closing);
    };
    const auto is_left_out = [&](int g) {
        const NodeGroups::Group& group = groups[index(g)];
        const Seen& carried = seen_[index(g)];
        const double gap = carried.distance - group.radius - highest - rough.off();
        if (gap < reach) {
            for (const int i : rough.groups().members(group))
                look_at(i);
            return false;
        }
        closest = std::fmin(closest, gap);
        const double time = time_to_cross(gap, haste);
        const double flies = stands ? time_to_fall(gap, carried.closing, rough.acceleration()) : 0;
        if (time > kWide * horizon_) {
            look_wide_in_ = std::fmin(look_wide_in_, time);
            wide_free_in_ = std::fmin(wide_free_in_, flies);
            return true;
        }
        quiet_in_ = std::fmin(quiet_in_, time);
        look_again_in_ = std::fmin(look_again_in_, time);
        free_in_ = std::fmin(free_in_, flies);
        return false;
    };
    std::erase_if(wide_, is_left_out);
    std::sort(candidate_.begin(), candidate_.end());
    look_again_in_ = std::fmin(look_again_in_, look_wide_in_);
    quiet_in_ = std::fmin(quiet_in_, look_wide_in_);
    free_in_ = std::fmin(std::fmin(free_in_, kLeap), std::fmax(wide_free_in_, look_wide_in_));
    for (const int i : candidate_) // poles climb over their neighbours
        if (has_pole(index(i)))
            for (const int t : nodes_.fan(nodes_.node[index(i)]))
                for (const int node : nodes_.triangle[index(t)])
                    rough.place(node);
    if (stands)
        foresee(position, velocity, pose, rough);
    const double farthest = reach + rough.off();
    find_points(position, pose, closest < farthest + 2 * nodes_.mean_edge, farthest);
    if (!samples_.exist())
        return;
    const double sliding = kHaste * (fastest + rough.speed() + sweeping(motion));
    look_again_in_ = std::fmin(look_again_in_, time_to_cross(farthest, sliding));
    if (samples_.is_near())
        quiet_in_ = free_in_ = 0;
}

void NodeContact::find_points(const NodeArray& position, const Pose& pose, bool near,
                              double reach) noexcept {
    // A triangle within reach of a sample has a corner not farther than an edge more.
    if (samples_.exist() && near)
        samples_.look(position, pose, reach);
    else
        samples_.look_away();
    if (!recess_.empty() && shape_.kind != ShapeKind::sphere)
        poles_.look(candidate_, position, pose);
}

double NodeContact::sweeping(const RigidMotion& motion) const noexcept {
    // Samples lie within size of the shape's middle; rotation may move them faster than any node
    // sees.
    const double span =
        shape_.kind == ShapeKind::convex ? samples_.reach() : shape_.size.norm() + shape_.size.x();
    return motion.spin.norm() * span;
}

double NodeContact::time_to_cross(double gap, double haste) noexcept {
    if (!(gap > 0 && gap < std::numeric_limits<double>::infinity()))
        return gap;
    return gap / (haste + std::sqrt(kAcceleration * gap / 2));
}

void NodeContact::probe_candidates(const NodeArray& position, const NodeArray& velocity,
                                   const RigidMotion& motion) noexcept {
    const Pose pose = shape_.pose.in(motion.pose);
    double fastest2 = 0;
    candidate_.clear();
    closing_ = std::numeric_limits<double>::infinity(); // not asked for
    planes_.clear();
    for (std::size_t i = 0; i < nodes_.node.size(); ++i) {
        const auto x = position[index(nodes_.node[i])];
        const Vec3 slip = velocity[index(nodes_.node[i])] - motion.velocity_at(x);
        fastest2 = std::fmax(fastest2, slip.squaredNorm());
        // A node that is in is looked at from outside, where ODE's answers are good.
        const Vec3 lift = anchored_[i] ? Vec3(0.5 * probe_->radius() * entered_[i]) : Vec3::Zero();
        Planes planes;
        planes.count = probe_->feel(shape_.probe, pose.to_local(x) + lift, planes.plane);
        if (planes.count == 0 &&
            !anchored_[i]) { // may be in already: ask from within the soft body
            const Vec3 inward = pose.rotation.transpose() * inward_at(nodes_, position, i);
            planes.count = probe_->feel(
                shape_.probe, pose.to_local(x) + 0.5 * probe_->radius() * inward, planes.plane);
        }
        if (planes.count == 0) {
            anchored_[i] = 0;
            continue;
        }
        candidate_.push_back(static_cast<int>(i));
        planes_.push_back(planes);
    }
    look_again_in_ = time_to_cross(probe_->radius(), kHaste * std::sqrt(fastest2));
}

} // namespace ode::soft
