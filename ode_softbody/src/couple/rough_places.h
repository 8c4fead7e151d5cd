#pragma once

#include "collide/rigid_pose.h"
#include "couple/node_groups.h"

#include <span>

namespace ode::soft {

/// A body whose nodes are brought up to date one by one, for those who ask: first as its frame
/// carries them, which tells what is far from a shape. Places and velocities are those of the
/// arrays that a look is given.
class RoughPlaces {
public:
    explicit RoughPlaces(const NodeGroups& groups, std::span<const Vec3> rest) noexcept
        : groups_(groups), rest_(rest) {}
    virtual ~RoughPlaces() = default;

    /// Of the surface nodes.
    const NodeGroups& groups() const noexcept { return groups_; }
    /// Of the frame, about its origin.
    const RigidMotion& frame() const noexcept { return frame_; }
    Vec3 carried(int node) const noexcept {
        return frame_.pose.to_world(rest_[static_cast<std::size_t>(node)]);
    }
    /// As the body goes on unpushed: how fast what its frame carries is accelerated, at most
    /// [m/s^2].
    double acceleration() const noexcept { return acceleration_; }
    /// The same of a node in the frame, along a direction of the world as the body stands: how far
    /// from where the frame carries it [m], and how fast it is accelerated [m/s^2].
    struct Swing {
        double way, acceleration;
    };
    virtual Swing swing(int node, const Vec3& direction) noexcept = 0;
    double off() const noexcept { return off_; }     ///< and any node in any direction [m]
    double rush() const noexcept { return rush_; }   ///< how fast, in any direction, it is [m/s]
    double speed() const noexcept { return speed_; } ///< that nodes have in the frame, in the mean

    virtual void carry(int node) noexcept = 0; ///< to where the frame takes it
    virtual void place(int node) noexcept = 0; ///< to where it is

protected:
    RigidMotion frame_;
    double off_ = 0;          ///< [m]
    double rush_ = 0;         ///< [m/s]
    double speed_ = 0;        ///< root of the mean square [m/s]
    double acceleration_ = 0; ///< [m/s^2]

private:
    const NodeGroups& groups_;
    std::span<const Vec3> rest_;
};

} // namespace ode::soft
