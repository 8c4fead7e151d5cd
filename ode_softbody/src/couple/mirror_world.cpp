// Which bodies and joints have twins, and what these are told at the start of a step.
#include "couple/mirror_world.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {
namespace {

Vec3 vec(const dReal* v) noexcept { return {v[0], v[1], v[2]}; }

bool is_mirrored(dJointID joint) noexcept {
    const dJointType type = dJointGetType(joint);
    return type != dJointTypeContact && type != dJointTypeNull && type != dJointTypeNone;
}

void set_mass(dBodyID twin, const dMass& mass) noexcept {
    dMass old;
    dBodyGetMass(twin, &old);
    if (old.mass != mass.mass || !std::equal(old.I, old.I + 12, mass.I) || dBodyIsKinematic(twin))
        dBodySetMass(twin, &mass);
}

void clear_forces(dBodyID twin) noexcept {
    dBodySetForce(twin, 0, 0, 0);
    dBodySetTorque(twin, 0, 0, 0);
}

} // namespace

MirrorWorld::~MirrorWorld() {
    if (world_)
        dWorldDestroy(world_);
}

void MirrorWorld::begin_step(dWorldID app, double h, double dt) noexcept {
    app_ = app;
    h_ = h;
    dt_ = dt;
    for (MirroredBody& body : body_)
        body.current = false;
    for (Joint& joint : joint_)
        joint.current = false;
}

MirroredBody* MirrorWorld::find(dBodyID app) noexcept {
    const auto found = std::find_if(body_.begin(), body_.end(),
                                    [&](const MirroredBody& b) { return b.app == app; });
    return found == body_.end() ? nullptr : &*found;
}

dBodyID MirrorWorld::twin_of(dBodyID app) {
    if (!app)
        return nullptr;
    MirroredBody* body = find(app);
    if (!body) {
        if (!world_)
            world_ = dWorldCreate();
        body = &body_.emplace_back();
        body->app = app;
        body->twin = dBodyCreate(world_);
        dBodySetAutoDisableFlag(body->twin, 0);
    }
    body->current = true;
    return body->twin;
}

void MirrorWorld::include(dBodyID app, bool propped) {
    twin_of(app);
    find(app)->propped = propped;
}

void MirrorWorld::drop_stale() noexcept {
    std::erase_if(joint_, [](const Joint& joint) {
        if (!joint.current)
            dJointDestroy(joint.twin);
        return !joint.current;
    });
    std::erase_if(body_, [](const MirroredBody& body) {
        if (!body.current)
            dBodyDestroy(body.twin);
        return !body.current;
    });
}

void MirrorWorld::mirror_joints() {
    // By index: the other end may be a kinematic body, which joins at the back and isn't searched.
    const std::size_t included = body_.size();
    for (std::size_t b = 0; b < included; ++b) {
        if (!body_[b].current)
            continue;
        for (int i = 0; i < dBodyGetNumJoints(body_[b].app); ++i) {
            const dJointID app = dBodyGetJoint(body_[b].app, i);
            if (!is_mirrored(app))
                continue;
            const dBodyID first = dJointGetBody(app, 0);
            const dBodyID second = dJointGetBody(app, 1);
            const auto known = std::find_if(joint_.begin(), joint_.end(), [&](const Joint& j) {
                return j.app == app && j.first == first && j.second == second &&
                       dJointGetType(j.twin) == dJointGetType(app);
            });
            if (known != joint_.end()) {
                known->current = true;
                twin_of(first);
                twin_of(second);
                continue;
            }
            const dBodyID one = twin_of(first);
            const dBodyID two = twin_of(second);
            joint_.push_back({app, create_twin(world_, app, one, two), first, second, true});
        }
    }
}

void MirrorWorld::build() {
    if (body_.empty())
        return;
    mirror_joints();
    drop_stale();
    if (body_.empty())
        return;
    dVector3 g;
    dWorldGetGravity(app_, g);
    dWorldSetGravity(world_, g[0], g[1], g[2]);
    // Geometry is compared in the application's pose; then the twins take their own.
    for (MirroredBody& body : body_)
        refresh(body);
    for (const Joint& joint : joint_)
        if (!same_geometry(joint.app, joint.twin))
            copy_geometry(joint.app, joint.twin);
    scale(dt_);
    find_accelerations();
    for (std::size_t i = 0; i < body_.size(); ++i) {
        MirroredBody& body = body_[i];
        if (!body.dynamic)
            continue;
        const TwinState now(body.app);
        if (body.live && body.known && now == body.written) {
            body.inner.apply(body.twin);
        } else if (!body.propped && dBodyIsEnabled(body.app)) {
            // A propped body may be at rest, which a shift by gravity alone would turn into a blow.
            TwinState start = now;
            start.set_twist(now.twist() + (h_ - dt_) / 2 * acceleration_[i]);
            start.apply(body.twin);
        }
        body.drift = acceleration_[i];
    }
    if (std::any_of(body_.begin(), body_.end(), [](const auto& b) { return b.asked; }))
        measure_mobility();
}

void MirrorWorld::refresh(MirroredBody& body) noexcept {
    const dBodyID app = body.app;
    const dBodyID twin = body.twin;
    TwinState(app).apply(twin);
    clear_forces(twin);
    dMass mass;
    dBodyGetMass(app, &mass);
    body.dynamic = !dBodyIsKinematic(app);
    body.touched = false;
    body.measured = false;
    body.contact = {};
    if (body.dynamic)
        set_mass(twin, mass);
    else if (!dBodyIsKinematic(twin))
        dBodySetKinematic(twin);
    body.external = {vec(dBodyGetForce(app)), vec(dBodyGetTorque(app))};
    body.mobility.setZero();
    Mat3 inertia;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            inertia(i, j) = mass.I[4 * i + j];
    if (body.dynamic) {
        body.mobility.topLeftCorner<3, 3>() = Mat3::Identity() / mass.mass;
        body.mobility.bottomRightCorner<3, 3>() = inertia.inverse();
    }
    dBodySetGravityMode(twin, dBodyGetGravityMode(app));
    dBodySetGyroscopicMode(twin, dBodyGetGyroscopicMode(app));
    dBodySetMaxAngularSpeed(twin, dBodyGetMaxAngularSpeed(app));
    dBodySetFiniteRotationMode(twin, dBodyGetFiniteRotationMode(app));
    dVector3 axis;
    dBodyGetFiniteRotationAxis(app, axis);
    dBodySetFiniteRotationAxis(twin, axis[0], axis[1], axis[2]);
    dBodySetLinearDampingThreshold(twin, dBodyGetLinearDampingThreshold(app));
    dBodySetAngularDampingThreshold(twin, dBodyGetAngularDampingThreshold(app));
    if (dBodyIsEnabled(app))
        dBodyEnable(twin);
    else
        dBodyDisable(twin);
}

void MirrorWorld::scale(double dt) noexcept {
    dt_ = dt;
    const Softness softness{dt / h_};
    const double erp = dWorldGetERP(app_);
    dWorldSetERP(world_, softness.erp(erp));
    dWorldSetCFM(world_, softness.cfm(erp, dWorldGetCFM(app_)));
    for (const Joint& joint : joint_)
        copy_parameters(joint.app, joint.twin, softness);
    for (const MirroredBody& body : body_) {
        // A factor a step, spread over its substeps.
        const auto spread = [&](double loss) { return 1 - std::pow(1 - loss, softness.ratio); };
        dBodySetLinearDamping(body.twin, spread(dBodyGetLinearDamping(body.app)));
        dBodySetAngularDamping(body.twin, spread(dBodyGetAngularDamping(body.app)));
    }
}

} // namespace ode::soft
