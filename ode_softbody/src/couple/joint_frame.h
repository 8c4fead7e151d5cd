#pragma once

#include "base/types.h"

#include <ode/common.h>

#include <array>

namespace ode::soft {

/// Where a joint is, as far as ODE tells, in the world's frame at the bodies' present pose. Unused
/// members are zero.
struct JointFrame {
    std::array<Vec3, 2> anchor; ///< as carried by the first and by the second body [m]
    std::array<Vec3, 3> axis;
    std::array<double, 3> angle; ///< about the axes [rad]
    double position;             ///< along a sliding axis [m]
    std::array<double, 4> extra; ///< the rest, by type
    std::array<int, 5> mode;     ///< counts and enumerators, by type
};

// Of frames of the same joint [m, rad]: getters turn vectors by matrices that are orthogonal to
// 1e-12 or so, and angles depend on a misalignment that can't be asked, 1e-4 rad at most, squared.
constexpr double kFrameTolerance = 1e-7;

JointFrame read_frame(dJointID joint) noexcept;

/// Gives a joint the frame that another has whose bodies stand in the same pose.
///
/// ODE takes the pose at which a setter is called for the zero of position and angles. So the
/// joint's first body is put where all of them are zero and both anchors meet, and back after the
/// call; which way to turn is found by asking, since ODE's signs vary with kind and order of
/// bodies.
void set_frame(dJointID joint, const JointFrame& frame) noexcept;

/// Largest difference of any member [m, rad].
double distance(const JointFrame& a, const JointFrame& b) noexcept;

} // namespace ode::soft
