#include "couple/joint_frame.h"

#include <ode/objects.h>

#include <cmath>

namespace ode::soft {
namespace {

/// Calls an ODE setter that takes three coordinates.
template <class Setter>
void tell(Setter set, dJointID joint, const Vec3& v) noexcept {
    set(joint, v.x(), v.y(), v.z());
}

/// The body that ODE counts as the first: there is one, in either order of attaching.
dBodyID mover_of(dJointID joint) noexcept {
    const dBodyID first = dJointGetBody(joint, 0);
    return first ? first : dJointGetBody(joint, 1);
}

struct BodyPose {
    explicit BodyPose(dBodyID body) noexcept {
        const dReal* x = dBodyGetPosition(body);
        const dReal* q = dBodyGetQuaternion(body);
        position = {x[0], x[1], x[2]};
        turn = Quat(q[0], q[1], q[2], q[3]);
    }
    void apply(dBodyID body) const noexcept {
        const dQuaternion q{turn.w(), turn.x(), turn.y(), turn.z()};
        dBodySetPosition(body, position.x(), position.y(), position.z());
        dBodySetQuaternion(body, q);
    }
    Vec3 position;
    Quat turn;
};

Quat turn_about(const Vec3& axis, double angle) noexcept {
    return angle == 0 ? Quat::Identity() : Quat(Eigen::AngleAxisd(angle, axis));
}

/// Setters, called while the mover stands at zero; axes of f are those of that pose.
void tell_frame(dJointID joint, const JointFrame& f) noexcept {
    const Vec3& anchor = f.anchor[1];
    switch (dJointGetType(joint)) {
    case dJointTypeBall:
        tell(dJointSetBallAnchor, joint, anchor);
        return;
    case dJointTypeHinge:
        tell(dJointSetHingeAnchor, joint, anchor);
        tell(dJointSetHingeAxis, joint, f.axis[0]);
        return;
    case dJointTypeSlider:
        tell(dJointSetSliderAxis, joint, f.axis[0]);
        return;
    case dJointTypeUniversal:
        tell(dJointSetUniversalAnchor, joint, anchor);
        tell(dJointSetUniversalAxis1, joint, f.axis[0]);
        tell(dJointSetUniversalAxis2, joint, f.axis[1]);
        return;
    case dJointTypeHinge2: {
        tell(dJointSetHinge2Anchor, joint, anchor);
        const dVector3 one{f.axis[0].x(), f.axis[0].y(), f.axis[0].z()};
        const dVector3 two{f.axis[1].x(), f.axis[1].y(), f.axis[1].z()};
        dJointSetHinge2Axes(joint, one, two);
        return;
    }
    case dJointTypeFixed:
        dJointSetFixed(joint);
        return;
    case dJointTypePR:
        tell(dJointSetPRAnchor, joint, anchor);
        tell(dJointSetPRAxis1, joint, f.axis[2]);
        tell(dJointSetPRAxis2, joint, f.axis[0]);
        return;
    case dJointTypePU:
        tell(dJointSetPUAnchor, joint, anchor);
        tell(dJointSetPUAxis1, joint, f.axis[0]);
        tell(dJointSetPUAxis2, joint, f.axis[1]);
        tell(dJointSetPUAxis3, joint, f.axis[2]);
        return;
    case dJointTypePiston:
        tell(dJointSetPistonAnchor, joint, anchor);
        tell(dJointSetPistonAxis, joint, f.axis[0]);
        return;
    case dJointTypeAMotor: {
        // Euler angles have references that can't be asked: a motor about the present axes at the
        // present angles stands in. It never counts as the same, so each step sets it anew.
        const bool euler = f.mode[1] == dAMotorEuler;
        constexpr int kEulerRelative[] = {1, 0, 2};
        dJointSetAMotorNumAxes(joint, f.mode[0]);
        for (int i = 0; i < f.mode[0]; ++i) {
            const auto n = static_cast<std::size_t>(i);
            dJointSetAMotorAxis(joint, i, euler ? kEulerRelative[i] : f.mode[2 + n], f.axis[n].x(),
                                f.axis[n].y(), f.axis[n].z());
            dJointSetAMotorAngle(joint, i, f.angle[n]);
        }
        return;
    }
    case dJointTypeLMotor:
        dJointSetLMotorNumAxes(joint, f.mode[0]);
        for (int i = 0; i < f.mode[0]; ++i) {
            const Vec3& a = f.axis[static_cast<std::size_t>(i)];
            dJointSetLMotorAxis(joint, i, 0, a.x(), a.y(), a.z());
        }
        return;
    case dJointTypeDHinge:
        tell(dJointSetDHingeAxis, joint, f.axis[0]);
        [[fallthrough]];
    case dJointTypeDBall:
        tell(dJointSetDBallAnchor1, joint, f.anchor[0]);
        tell(dJointSetDBallAnchor2, joint, f.anchor[1]);
        dJointSetDBallDistance(joint, f.extra[0]);
        return;
    case dJointTypeTransmission:
        dJointSetTransmissionMode(joint, f.mode[0]);
        tell(dJointSetTransmissionAnchor1, joint, f.anchor[0]);
        tell(dJointSetTransmissionAnchor2, joint, f.anchor[1]);
        if (f.mode[0] == dTransmissionIntersectingAxes) {
            tell(dJointSetTransmissionAxis1, joint, f.axis[0]);
            tell(dJointSetTransmissionAxis2, joint, f.axis[1]);
        } else {
            tell(dJointSetTransmissionAxis, joint, f.axis[0]);
        }
        if (f.mode[0] == dTransmissionParallelAxes)
            dJointSetTransmissionRatio(joint, f.extra[0]);
        if (f.mode[0] == dTransmissionChainDrive) {
            dJointSetTransmissionRadius1(joint, f.extra[1]);
            dJointSetTransmissionRadius2(joint, f.extra[2]);
        }
        dJointSetTransmissionBacklash(joint, f.extra[3]);
        return;
    default:
        return;
    }
}

/// Whether setters at zero make a difference: the joint measures an angle or a position.
bool measures(dJointID joint) noexcept {
    switch (dJointGetType(joint)) {
    case dJointTypeHinge:
    case dJointTypeSlider:
    case dJointTypeUniversal:
    case dJointTypeHinge2:
    case dJointTypePR:
    case dJointTypePU:
    case dJointTypePiston:
    case dJointTypeBall:
        return true;
    default:
        return false;
    }
}

/// The mover's pose at zero and the frame there, for one choice of signs (bits: angles, position).
void tell_at_zero(dJointID joint, const JointFrame& f, unsigned signs) noexcept {
    const dBodyID mover = mover_of(joint);
    const bool reversed = !dJointGetBody(joint, 0);
    const BodyPose start(mover);
    const auto sign = [&](unsigned bit) { return (signs >> bit & 1U) == 0 ? -1.0 : 1.0; };
    const auto part = [&](unsigned i) { return turn_about(f.axis[i], sign(i) * f.angle[i]); };

    // Turning about the mover's own axis first leaves the others where they are.
    const dJointType type = dJointGetType(joint);
    Quat turn = Quat::Identity();
    JointFrame at_zero = f;
    if (type == dJointTypeUniversal || type == dJointTypePU || type == dJointTypeHinge2) {
        turn = reversed ? part(0) * part(1) : part(1) * part(0);
        at_zero.axis[reversed ? 1 : 0] = turn * f.axis[reversed ? 1 : 0];
    } else {
        turn = part(0);
    }
    BodyPose zero = start;
    zero.turn = turn * start.turn;
    if (type == dJointTypeSlider) {
        zero.position += sign(3) * f.position * f.axis[0];
    } else if (type == dJointTypePR || type == dJointTypePU) {
        // Only the second body's anchor can be asked: slide back to it, then turn about it.
        const Vec3 slid = start.position + sign(3) * f.position * f.axis[2];
        zero.position = f.anchor[1] + turn * (slid - f.anchor[1]);
        at_zero.axis[2] = turn * f.axis[2];
    } else {
        const Vec3& carried = f.anchor[reversed ? 1 : 0];
        const Vec3& other = f.anchor[reversed ? 0 : 1];
        zero.position = other + turn * (start.position - carried);
        at_zero.anchor[1] = other;
    }
    zero.apply(mover);
    tell_frame(joint, at_zero);
    start.apply(mover);
}

} // namespace

void set_frame(dJointID joint, const JointFrame& frame) noexcept {
    if (!measures(joint)) {
        tell_frame(joint, frame);
        return;
    }
    unsigned best = 0;
    double least = HUGE_VAL;
    for (unsigned signs = 0; signs < 16; ++signs) {
        tell_at_zero(joint, frame, signs);
        const double off = distance(read_frame(joint), frame);
        if (off < least) {
            least = off;
            best = signs;
        }
        if (off < kFrameTolerance)
            return;
    }
    tell_at_zero(joint, frame, best);
}

} // namespace ode::soft
