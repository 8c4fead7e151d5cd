// For how long what is near a shape that stands still cannot touch it, if nothing pushes the body.
#include "couple/free_flight.h"
#include "couple/node_contact.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {
namespace {

std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }

} // namespace

const NodeContact::Approach& NodeContact::approach_of(int node, const NodeArray& position,
                                                      const NodeArray& velocity, const Pose& pose,
                                                      RoughPlaces& rough) noexcept {
    const auto known = std::find_if(approach_.begin(), approach_.end(),
                                    [&](const Approach& a) { return a.node == node; });
    if (known != approach_.end())
        return *known;
    rough.place(node);
    const Vec3 carried = rough.carried(node);
    const SurfaceDistance there = shape_.distance(pose.to_local(carried));
    const Vec3 normal = pose.rotation * there.normal;
    const RoughPlaces::Swing swing = rough.swing(node, normal);
    // What of the swing comes to point along the normal while the body turns.
    const double turned = std::fmin(1.0, kLeap * rough.frame().spin.norm()) * rough.off();
    // From a convex shape the distance grows at least as along the normal.
    return approach_.emplace_back(
        Approach{.node = node,
                 .gap = there.distance + normal.dot(position[index(node)] - carried),
                 .closing = -normal.dot(velocity[index(node)]),
                 .acceleration = rough.acceleration() + swing.acceleration,
                 .least_gap = there.distance - swing.way - turned,
                 .carried_closing = -normal.dot(rough.frame().velocity_at(carried))});
}

void NodeContact::foresee(const NodeArray& position, const NodeArray& velocity, const Pose& pose,
                          RoughPlaces& rough) noexcept {
    approach_.clear();
    const double carried_by = rough.acceleration();
    for (const int i : candidate_) {
        if (!(free_in_ > 0))
            break;
        const Approach node = approach_of(nodes_.node[index(i)], position, velocity, pose, rough);
        // Its bulge, of no more than `over`, may be the first to touch.
        const auto free_time = [&](double over) {
            return std::fmax(time_to_fall(node.least_gap - over, node.carried_closing, carried_by),
                             time_to_fall(node.gap - over, node.closing, node.acceleration));
        };
        free_in_ = std::fmin(free_in_, free_time(0));
        if (!has_pole(index(i)) || free_time(nodes_.shape.highest) >= free_in_)
            continue;
        for (const int t : nodes_.fan(node.node)) {
            Vec3 depth, most;
            double closing = 0, carried_closing = 0, acceleration = 0;
            for (int c = 0; c < 3; ++c) {
                const Approach& corner = approach_of(nodes_.triangle[index(t)][index(c)], position,
                                                     velocity, pose, rough);
                depth[c] = -corner.gap;
                most[c] = -corner.least_gap;
                closing = c == 0 ? corner.closing : std::fmax(closing, corner.closing);
                carried_closing = c == 0 ? corner.carried_closing
                                         : std::fmax(carried_closing, corner.carried_closing);
                acceleration = std::fmax(acceleration, corner.acceleration);
            }
            const std::array<double, 3>& bulge = nodes_.shape.bulge[index(t)];
            Vec3 where;
            const double now = highest_point(depth, bulge, where);
            const double ever = highest_point(most, bulge, where);
            free_in_ =
                std::fmin(free_in_, std::fmax(time_to_fall(-ever, carried_closing, carried_by),
                                              time_to_fall(-now, closing, acceleration)));
        }
    }
}

} // namespace ode::soft
