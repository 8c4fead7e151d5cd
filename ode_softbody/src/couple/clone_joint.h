#pragma once

#include <ode/common.h>

namespace ode::soft {

/// How softness is carried from the application's step to a substep. ODE's pair of error reduction
/// and constraint force mixing at step h is a spring and a damper (ODE's manual, "Soft constraint
/// and constraint force mixing"), erp = h k / (h k + c), cfm = 1 / (h k + c). The same spring and
/// damper at the step dt = ratio * h give what these return: errors fade per second as they do in
/// the application, and a rigid joint stays rigid.
struct Softness {
    double ratio; ///< substep by step

    double erp(double erp) const noexcept;
    double cfm(double erp, double cfm) const noexcept;
};

/// A joint of the kind of `app` in another world, attached to twins of its bodies.
/// @return nullptr for contact and null joints.
dJointID create_twin(dWorldID world, dJointID app, dBodyID first, dBodyID second) noexcept;

/// Anchors, axes, positions and angles of `app` become those of its twin, whose bodies stand where
/// the application's stand. What ODE can't be asked is taken as fulfilled: the misalignment, as
/// large as ODE's own error, of the second body's hinge, slider, piston or prismatic axis, and of a
/// fixed joint. The axes of a linear motor are taken for the world's, a Plane2D's motors for
/// absent; Euler motors act about the axes and at the angles of the step's start. A PU joint
/// attached as (nullptr, body) is not followed faithfully.
void copy_geometry(dJointID app, dJointID twin) noexcept;

/// Whether all that can be asked of the geometry agrees within ODE's rounding. Both stand in the
/// same pose.
bool same_geometry(dJointID app, dJointID twin) noexcept;

/// Limits, motors, softness, being enabled.
void copy_parameters(dJointID app, dJointID twin, const Softness& softness) noexcept;

} // namespace ode::soft
