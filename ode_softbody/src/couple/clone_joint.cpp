#include "couple/clone_joint.h"

#include "couple/joint_frame.h"

#include <ode/objects.h>

#include <algorithm>

namespace ode::soft {
namespace {

// An error reduction of 1 would throw all of a joint's error into one substep's velocity.
constexpr double kMostErp = 0.95;

using Create = dJointID (*)(dWorldID, dJointGroupID);
using Get = dReal (*)(dJointID, int);
using Set = void (*)(dJointID, int, dReal);

/// What a joint's parameters are reached by.
struct Kind {
    dJointType type;
    Create create;
    Get get;
    Set set;
    int axes;  ///< groups of limits and motors
    bool soft; ///< has dParamERP and dParamCFM of its own rows
};

constexpr Kind kKinds[] = {
    {dJointTypeBall, dJointCreateBall, dJointGetBallParam, dJointSetBallParam, 0, true},
    {dJointTypeHinge, dJointCreateHinge, dJointGetHingeParam, dJointSetHingeParam, 1, false},
    {dJointTypeSlider, dJointCreateSlider, dJointGetSliderParam, dJointSetSliderParam, 1, false},
    {dJointTypeUniversal, dJointCreateUniversal, dJointGetUniversalParam, dJointSetUniversalParam,
     2, false},
    {dJointTypeHinge2, dJointCreateHinge2, dJointGetHinge2Param, dJointSetHinge2Param, 2, false},
    {dJointTypeFixed, dJointCreateFixed, dJointGetFixedParam, dJointSetFixedParam, 0, true},
    {dJointTypeAMotor, dJointCreateAMotor, dJointGetAMotorParam, dJointSetAMotorParam, 3, false},
    {dJointTypeLMotor, dJointCreateLMotor, dJointGetLMotorParam, dJointSetLMotorParam, 3, false},
    {dJointTypePlane2D, dJointCreatePlane2D, nullptr, nullptr, 0, false},
    {dJointTypePR, dJointCreatePR, dJointGetPRParam, dJointSetPRParam, 2, false},
    {dJointTypePU, dJointCreatePU, dJointGetPUParam, dJointSetPUParam, 3, false},
    {dJointTypePiston, dJointCreatePiston, dJointGetPistonParam, dJointSetPistonParam, 2, false},
    {dJointTypeDBall, dJointCreateDBall, dJointGetDBallParam, dJointSetDBallParam, 0, true},
    {dJointTypeDHinge, dJointCreateDHinge, dJointGetDHingeParam, dJointSetDHingeParam, 0, true},
    {dJointTypeTransmission, dJointCreateTransmission, dJointGetTransmissionParam,
     dJointSetTransmissionParam, 0, true},
};

const Kind* kind_of(dJointID joint) noexcept {
    const dJointType type = dJointGetType(joint);
    const auto* found = std::find_if(std::begin(kKinds), std::end(kKinds),
                                     [&](const Kind& k) { return k.type == type; });
    return found == std::end(kKinds) ? nullptr : found;
}

/// One axis' limits and motor. @param group  of the parameter, added to its number.
void copy_axis(const Kind& kind, dJointID app, dJointID twin, int group,
               const Softness& softness) noexcept {
    const auto get = [&](int parameter) { return kind.get(app, parameter + group); };
    const auto set = [&](int parameter, double value) { kind.set(twin, parameter + group, value); };
    for (const int parameter : {dParamLoStop, dParamHiStop, dParamVel, dParamFMax,
                                dParamFudgeFactor, dParamBounce, dParamCFM})
        set(parameter, get(parameter)); // a motor's CFM is a pure damper's: no step in it
    set(dParamStopERP, softness.erp(get(dParamStopERP)));
    set(dParamStopCFM, softness.cfm(get(dParamStopERP), get(dParamStopCFM)));
}

} // namespace

double Softness::erp(double erp) const noexcept {
    erp = std::clamp(erp, 0.0, kMostErp);
    return ratio * erp / (ratio * erp + 1 - erp);
}

double Softness::cfm(double erp, double cfm) const noexcept {
    erp = std::clamp(erp, 0.0, kMostErp);
    return cfm / (ratio * erp + 1 - erp);
}

dJointID create_twin(dWorldID world, dJointID app, dBodyID first, dBodyID second) noexcept {
    const Kind* kind = kind_of(app);
    if (!kind)
        return nullptr;
    const dJointID twin = kind->create(world, nullptr);
    dJointAttach(twin, first, second);
    return twin;
}

void copy_parameters(dJointID app, dJointID twin, const Softness& softness) noexcept {
    if (dJointIsEnabled(app))
        dJointEnable(twin);
    else
        dJointDisable(twin);
    const Kind& kind = *kind_of(app);
    for (int axis = 0; axis < kind.axes; ++axis)
        copy_axis(kind, app, twin, axis * dParamGroup, softness);
    const auto soften = [&](int erp, int cfm) {
        kind.set(twin, erp, softness.erp(kind.get(app, erp)));
        kind.set(twin, cfm, softness.cfm(kind.get(app, erp), kind.get(app, cfm)));
    };
    if (kind.soft)
        soften(dParamERP, dParamCFM);
    if (kind.type == dJointTypeHinge2)
        soften(dParamSuspensionERP, dParamSuspensionCFM);
}

void copy_geometry(dJointID app, dJointID twin) noexcept { set_frame(twin, read_frame(app)); }

bool same_geometry(dJointID app, dJointID twin) noexcept {
    return distance(read_frame(app), read_frame(twin)) < kFrameTolerance;
}

} // namespace ode::soft
