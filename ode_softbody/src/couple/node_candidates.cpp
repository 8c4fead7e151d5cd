// Which nodes, samples and poles a substep has to look at, and for how long that holds.
#include "couple/node_contact.h"
#include "couple/outward.h"

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
                                  const RigidMotion& motion, RoughPlaces& rough) noexcept {
    const Pose pose = shape_.pose.in(motion.pose);
    const double most = kReach * nodes_.mean_edge;
    const double trembling = kHaste * rough.speed();
    const bool all = look_wide_in_ <= 0 || samples_.exist();
    double farthest = 0; // reach of any
    double closest = std::numeric_limits<double>::infinity();
    double fastest2 = 0;
    look_again_in_ = quiet_in_ = closest;
    if (all) {
        wide_.resize(nodes_.node.size());
        std::iota(wide_.begin(), wide_.end(), 0);
        look_wide_in_ = closest;
    }
    candidate_.clear();
    closing_ *= kFading;
    const auto is_left_out = [&](int i) {
        const int node = nodes_.node[index(i)];
        rough.carry(node);
        const auto x = position[index(node)];
        const auto slip = [&] { return Vec3(velocity[index(node)] - motion.velocity_at(x)); };
        const double carried2 = slip().squaredNorm();
        double haste = trembling + kTurning * std::sqrt(carried2);
        const double reach = std::fmin(most, horizon_ * (haste + kAcceleration / 2 * horizon_));
        // A bulge may touch before its node does.
        const double stands_out = has_pole(index(i)) ? nodes_.shape.highest : 0;
        SurfaceDistance there = shape_.distance(pose.to_local(x));
        double gap = there.distance - stands_out - rough.off();
        const double time = time_to_cross(gap, haste);
        fastest2 = std::fmax(fastest2, carried2);
        farthest = std::fmax(farthest, reach);
        closest = std::fmin(closest, gap);
        if (gap >= reach) {
            quiet_in_ = std::fmin(quiet_in_, time);
            if (time > kWide * horizon_) {
                look_wide_in_ = std::fmin(look_wide_in_, time);
                return true;
            }
            look_again_in_ = std::fmin(look_again_in_, time);
            return false;
        }
        rough.place(node);
        there = shape_.distance(pose.to_local(x));
        gap = there.distance - stands_out;
        haste = std::fmax(haste, kTurning * slip().norm());
        quiet_in_ = std::fmin(quiet_in_, std::fmax(0.0, time_to_cross(gap, haste)));
        candidate_.push_back(i);
        closing_ = std::fmax(closing_, -slip().dot(pose.rotation * there.normal));
        return false;
    };
    std::erase_if(wide_, is_left_out);
    look_again_in_ = std::fmin(look_again_in_, look_wide_in_);
    quiet_in_ = std::fmin(quiet_in_, look_wide_in_);
    for (const int i : candidate_) // poles climb over their neighbours
        if (has_pole(index(i)))
            for (const int t : nodes_.fan(nodes_.node[index(i)]))
                for (const int node : nodes_.triangle[index(t)])
                    rough.place(node);
    const double reach = farthest + rough.off();
    find_points(position, pose, closest < reach + 2 * nodes_.mean_edge, reach);
    if (!samples_.exist())
        return;
    const double haste = kHaste * (std::sqrt(fastest2) + rough.speed() + sweeping(motion));
    look_again_in_ = std::fmin(look_again_in_, time_to_cross(reach, haste));
    if (samples_.is_near())
        quiet_in_ = 0;
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
