// Which nodes, samples and poles a substep has to look at, and for how long that holds.
#include "couple/node_contact.h"
#include "couple/outward.h"

#include <cmath>
#include <limits>

namespace ode::soft {
namespace {

// How far nodes may get before they are looked at anew: elastic waves may make them kHaste times
// as fast as the fastest is now, free bodies may accelerate by kAcceleration.
constexpr double kHaste = 4;
constexpr double kAcceleration = 1000; ///< [m/s^2]
constexpr double kLeastReach = 0.01;   ///< [mean edges]
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
    const double most = kReach * nodes_.mean_edge;
    const double least = kLeastReach * nodes_.mean_edge;
    const double reach =
        horizon_ > 0 ? std::fmin(most, std::fmax(least, kHaste * fastest_ * horizon_)) : most;
    double nearest = std::numeric_limits<double>::infinity(); // of those left out
    double closest = nearest;                                 // of all
    double fastest2 = 0;
    candidate_.clear();
    closing_ *= kFading;
    for (std::size_t i = 0; i < nodes_.node.size(); ++i) {
        const auto x = position[index(nodes_.node[i])];
        const Vec3 slip = velocity[index(nodes_.node[i])] - motion.velocity_at(x);
        fastest2 = std::fmax(fastest2, slip.squaredNorm());
        const SurfaceDistance there = shape_.distance(pose.to_local(x));
        const double distance = there.distance;
        closest = std::fmin(closest, distance);
        // A bulge may touch before its node does.
        const double stands_out = horizon_ > 0 && has_pole(i) ? nodes_.shape.highest : 0;
        if (distance < reach + stands_out) {
            candidate_.push_back(static_cast<int>(i));
            closing_ = std::fmax(closing_, -slip.dot(pose.rotation * there.normal));
        } else
            nearest = std::fmin(nearest, distance - stands_out);
    }
    // A triangle within reach of a sample has a corner not farther than an edge more.
    if (closest < reach + 2 * nodes_.mean_edge) {
        samples_.look(position, pose, reach);
        nearest = std::fmin(nearest, reach); // as far as they may slide
    } else
        samples_.look_away();
    if (!recess_.empty() && shape_.kind != ShapeKind::sphere)
        poles_.look(candidate_, position, pose);
    // Samples lie within size of the shape's middle; rotation may move them faster than any node
    // sees.
    const double span =
        shape_.kind == ShapeKind::convex ? samples_.reach() : shape_.size.norm() + shape_.size.x();
    fastest_ = std::sqrt(fastest2) + motion.spin.norm() * span;
    look_again_in_ = time_to_cross(nearest, fastest_);
    const double gap = closest - nodes_.shape.highest;
    if (gap > 0 && !samples_.is_near())
        quiet_in_ = time_to_cross(gap, fastest_);
}

double NodeContact::time_to_cross(double gap, double fastest) noexcept {
    return gap / (kHaste * fastest + std::sqrt(kAcceleration * gap / 2));
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
    look_again_in_ = time_to_cross(probe_->radius(), std::sqrt(fastest2));
}

} // namespace ode::soft
