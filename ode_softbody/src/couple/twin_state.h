#pragma once

#include "collide/rigid_pose.h"

#include <ode/objects.h>

#include <algorithm>
#include <array>

namespace ode::soft {

using Vec6 = Eigen::Matrix<double, 6, 1>; ///< linear part, then angular
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// All that moves of an ODE body, bit for bit.
struct TwinState {
    TwinState() = default;
    explicit TwinState(dBodyID body) noexcept {
        std::copy_n(dBodyGetPosition(body), 3, position.begin());
        std::copy_n(dBodyGetQuaternion(body), 4, quaternion.begin());
        std::copy_n(dBodyGetLinearVel(body), 3, velocity.begin());
        std::copy_n(dBodyGetAngularVel(body), 3, spin.begin());
    }
    void apply(dBodyID body) const noexcept {
        dBodySetPosition(body, position[0], position[1], position[2]);
        dBodySetQuaternion(body, quaternion.data());
        dBodySetLinearVel(body, velocity[0], velocity[1], velocity[2]);
        dBodySetAngularVel(body, spin[0], spin[1], spin[2]);
    }
    bool operator==(const TwinState&) const = default;

    Vec6 twist() const noexcept {
        Vec6 v;
        v << velocity[0], velocity[1], velocity[2], spin[0], spin[1], spin[2];
        return v;
    }
    void set_twist(const Vec6& v) noexcept {
        velocity = {v[0], v[1], v[2]};
        spin = {v[3], v[4], v[5]};
    }

    std::array<dReal, 3> position{};
    std::array<dReal, 4> quaternion{};
    std::array<dReal, 3> velocity{};
    std::array<dReal, 3> spin{};
};

} // namespace ode::soft
