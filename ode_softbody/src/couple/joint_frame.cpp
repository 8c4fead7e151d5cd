#include "couple/joint_frame.h"

#include <ode/objects.h>

#include <cmath>
#include <numbers>

namespace ode::soft {
namespace {

using Getter = void (*)(dJointID, dVector3);
using AngleGetter = dReal (*)(dJointID);

Vec3 ask(Getter get, dJointID joint) noexcept {
    dVector3 v;
    get(joint, v);
    return {v[0], v[1], v[2]};
}

JointFrame blank() noexcept {
    JointFrame f;
    f.anchor.fill(Vec3::Zero());
    f.axis.fill(Vec3::Zero());
    f.angle.fill(0);
    f.position = 0;
    f.extra.fill(0);
    f.mode.fill(0);
    return f;
}

double wrapped(double angle) noexcept {
    return std::fabs(std::remainder(angle, 2 * std::numbers::pi));
}

} // namespace

JointFrame read_frame(dJointID joint) noexcept {
    JointFrame f = blank();
    const auto anchors = [&](Getter one, Getter two) {
        f.anchor = {ask(one, joint), ask(two, joint)};
    };
    const auto two_axes = [&](Getter one, Getter two, AngleGetter first, AngleGetter second) {
        f.axis[0] = ask(one, joint);
        f.axis[1] = ask(two, joint);
        f.angle[0] = first(joint);
        f.angle[1] = second(joint);
    };
    switch (dJointGetType(joint)) {
    case dJointTypeBall:
        anchors(dJointGetBallAnchor, dJointGetBallAnchor2);
        break;
    case dJointTypeHinge:
        anchors(dJointGetHingeAnchor, dJointGetHingeAnchor2);
        f.axis[0] = ask(dJointGetHingeAxis, joint);
        f.angle[0] = dJointGetHingeAngle(joint);
        break;
    case dJointTypeSlider:
        f.axis[0] = ask(dJointGetSliderAxis, joint);
        f.position = dJointGetSliderPosition(joint);
        break;
    case dJointTypeUniversal:
        anchors(dJointGetUniversalAnchor, dJointGetUniversalAnchor2);
        two_axes(dJointGetUniversalAxis1, dJointGetUniversalAxis2, dJointGetUniversalAngle1,
                 dJointGetUniversalAngle2);
        break;
    case dJointTypeHinge2:
        anchors(dJointGetHinge2Anchor, dJointGetHinge2Anchor2);
        two_axes(dJointGetHinge2Axis1, dJointGetHinge2Axis2, dJointGetHinge2Angle1,
                 dJointGetHinge2Angle2);
        break;
    case dJointTypePR:
        f.anchor[1] = ask(dJointGetPRAnchor, joint);
        f.axis[2] = ask(dJointGetPRAxis1, joint);
        f.axis[0] = ask(dJointGetPRAxis2, joint);
        f.position = dJointGetPRPosition(joint);
        f.angle[0] = dJointGetPRAngle(joint);
        break;
    case dJointTypePU:
        f.anchor[1] = ask(dJointGetPUAnchor, joint);
        two_axes(dJointGetPUAxis1, dJointGetPUAxis2, dJointGetPUAngle1, dJointGetPUAngle2);
        f.axis[2] = ask(dJointGetPUAxis3, joint);
        f.position = dJointGetPUPosition(joint);
        break;
    case dJointTypePiston:
        anchors(dJointGetPistonAnchor, dJointGetPistonAnchor2);
        f.axis[0] = ask(dJointGetPistonAxis, joint);
        f.position = dJointGetPistonPosition(joint);
        f.angle[0] = dJointGetPistonAngle(joint);
        break;
    case dJointTypeAMotor:
        f.mode[0] = dJointGetAMotorNumAxes(joint);
        f.mode[1] = dJointGetAMotorMode(joint);
        for (int i = 0; i < f.mode[0]; ++i) {
            const auto n = static_cast<std::size_t>(i);
            dVector3 axis;
            dJointGetAMotorAxis(joint, i, axis);
            f.axis[n] = {axis[0], axis[1], axis[2]};
            f.angle[n] = dJointGetAMotorAngle(joint, i);
            f.mode[2 + n] = dJointGetAMotorAxisRel(joint, i);
        }
        break;
    case dJointTypeLMotor:
        f.mode[0] = dJointGetLMotorNumAxes(joint);
        for (int i = 0; i < f.mode[0]; ++i) {
            dVector3 axis;
            dJointGetLMotorAxis(joint, i, axis);
            f.axis[static_cast<std::size_t>(i)] = {axis[0], axis[1], axis[2]};
        }
        break;
    case dJointTypeDHinge:
        f.axis[0] = ask(dJointGetDHingeAxis, joint);
        [[fallthrough]];
    case dJointTypeDBall:
        anchors(dJointGetDBallAnchor1, dJointGetDBallAnchor2);
        f.extra[0] = dJointGetDBallDistance(joint);
        break;
    case dJointTypeTransmission:
        f.mode[0] = dJointGetTransmissionMode(joint);
        anchors(dJointGetTransmissionAnchor1, dJointGetTransmissionAnchor2);
        f.axis[0] = ask(dJointGetTransmissionAxis1, joint);
        f.axis[1] = ask(dJointGetTransmissionAxis2, joint);
        f.extra = {dJointGetTransmissionRatio(joint), dJointGetTransmissionRadius1(joint),
                   dJointGetTransmissionRadius2(joint), dJointGetTransmissionBacklash(joint)};
        break;
    default:
        break;
    }
    return f;
}

double distance(const JointFrame& a, const JointFrame& b) noexcept {
    double most = std::fabs(a.position - b.position);
    for (std::size_t i = 0; i < 2; ++i)
        most = std::fmax(most, (a.anchor[i] - b.anchor[i]).norm());
    for (std::size_t i = 0; i < 3; ++i) {
        most = std::fmax(most, (a.axis[i] - b.axis[i]).norm());
        most = std::fmax(most, wrapped(a.angle[i] - b.angle[i]));
    }
    for (std::size_t i = 0; i < a.extra.size(); ++i)
        most = std::fmax(most, std::fabs(a.extra[i] - b.extra[i]));
    return a.mode == b.mode ? most : HUGE_VAL;
}

} // namespace ode::soft
