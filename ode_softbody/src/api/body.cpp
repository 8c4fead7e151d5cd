#include "api/boundary.h"
#include "api/editing.h"
#include "api/handles.h"
#include "api/solid.h"
#include "api/versioned.h"
#include "modal/solve_modes.h"

#include <ode/objects.h>
#include <ode/odemath.h>

#include <algorithm>
#include <cmath>

using namespace ode::soft;

namespace {

bool all_finite(std::initializer_list<dReal> values) noexcept {
    return std::all_of(values.begin(), values.end(), [](dReal v) { return std::isfinite(v); });
}

int refuse(const char* function, const char* what) noexcept {
    report(format("%s: %s is not finite; the body is left as it was", function, what));
    return 0;
}

bool has_node(const Body& body, int node, const char* function) noexcept {
    if (node >= 0 && static_cast<std::size_t>(node) < body.mesh().node.size())
        return true;
    report(format("%s: the body has no node %d; its nodes are 0 to %zu", function, node,
                  body.mesh().node.size() - 1));
    return false;
}

} // namespace

dSoftBodyID dSoftBodyCreate(dSoftWorldID world, dSoftMeshID mesh, const dSoftSolid* solid) {
    require_id(solid, __func__);
    SoftWorld* home = live(world, __func__);
    const dxSoftMesh* shape = live(mesh, __func__);
    if (!home || !shape || !may_edit(*home, __func__))
        return nullptr;
    return guarded(__func__, dSoftBodyID{}, [&] {
        const Solid one = from_c(*solid);
        return to_id(home->create_body(shape->mesh, {&one, 1}));
    });
}

void dSoftBodyDestroy(dSoftBodyID id) {
    Body* body = LiveId<Body>::find(id); // one that ended with its world is no mistake
    if (body && may_edit(body->world(), __func__))
        body->world().destroy_body(*body);
}

void dSoftBodySetData(dSoftBodyID id, void* data) {
    Body* body = live(id, __func__);
    if (!body)
        return;
    body->data = data;
}

void* dSoftBodyGetData(dSoftBodyID id) {
    Body* body = live(id, __func__);
    if (!body)
        return nullptr;
    return body->data;
}

int dSoftBodySetSubstep(dSoftBodyID id, dReal dt) {
    Body* body = live(id, __func__);
    if (!body)
        return 0;
    if (dt == 0) {
        body->use_default_substep();
        return 1;
    }
    if (!(dt > 0 && std::isfinite(dt) && dt <= body->longest_substep())) {
        report(
            format("dSoftBodySetSubstep: %g s is outside (0, %g s], the stable range of this body; "
                   "give 0 to let the library choose",
                   dt, body->longest_substep()));
        return 0;
    }
    body->set_substep(dt);
    return 1;
}

dReal dSoftBodyGetSubstep(dSoftBodyID id) {
    Body* body = live(id, __func__);
    if (!body)
        return 0;
    return body->substep();
}

dReal dSoftBodyGetCriticalStep(dSoftBodyID id) {
    Body* body = live(id, __func__);
    if (!body)
        return 0;
    return body->critical_step();
}

dReal dSoftBodyEstimateCriticalStep(dSoftBodyID id) {
    Body* body = live(id, __func__);
    if (!body)
        return 0;
    return guarded(__func__, dReal(0), [&] { return body->present_critical_step(); });
}

int dSoftBodySetPosition(dSoftBodyID id, dReal x, dReal y, dReal z) {
    Body* body = live(id, __func__);
    if (!body || !may_edit(body->world(), __func__))
        return 0;
    if (!all_finite({x, y, z}))
        return refuse(__func__, "the position");
    body->move_to({x, y, z});
    return 1;
}

int dSoftBodyRotate(dSoftBodyID id, const dQuaternion q) {
    Body* body = live(id, __func__);
    if (!body || !may_edit(body->world(), __func__))
        return 0;
    const Quat rotation(q[0], q[1], q[2], q[3]);
    constexpr double kUnit = 1e-6; // a quaternion from ODE is normalised to rounding
    if (!(std::abs(rotation.norm() - 1) < kUnit)) {
        report(
            format("dSoftBodyRotate: the quaternion has length %g; normalise it", rotation.norm()));
        return 0;
    }
    body->rotate(rotation.normalized());
    return 1;
}

int dSoftBodySetLinearVel(dSoftBodyID id, dReal x, dReal y, dReal z) {
    Body* body = live(id, __func__);
    if (!body)
        return 0;
    if (!all_finite({x, y, z}))
        return refuse(__func__, "the velocity");
    body->set_velocity({x, y, z});
    return 1;
}

int dSoftBodyAddAngularVel(dSoftBodyID id, dReal x, dReal y, dReal z) {
    Body* body = live(id, __func__);
    if (!body)
        return 0;
    if (!all_finite({x, y, z}))
        return refuse(__func__, "the angular velocity");
    body->add_spin({x, y, z});
    return 1;
}

int dSoftBodyPinNodes(dSoftBodyID id, const int* nodes, int count) {
    Body* body = live(id, __func__);
    if (!body)
        return 0;
    for (int i = 0; i < count; ++i)
        if (!has_node(*body, nodes[i], __func__))
            return 0;
    return guarded(__func__, 0, [&] {
        body->pin({nodes, static_cast<std::size_t>(std::max(count, 0))});
        return static_cast<int>(body->pinned().size());
    });
}

void dSoftBodyUnpin(dSoftBodyID id) {
    Body* body = live(id, __func__);
    if (!body)
        return;
    body->unpin();
}

int dSoftBodyAttachNodes(dSoftBodyID id, dBodyID rigid, const int* nodes, int count) {
    if (!rigid)
        return dSoftBodyPinNodes(id, nodes, count);
    Body* body = live(id, __func__);
    if (!body || !may_edit(body->world(), __func__))
        return 0;
    for (int i = 0; i < count; ++i)
        if (!has_node(*body, nodes[i], __func__))
            return 0;
    return guarded(__func__, 0, [&] {
        if (dBodyGetWorld(rigid) != body->world().ode_world())
            throw InputError("the rigid body is of another ODE world than the soft one's");
        return body->world().attachments().attach(
            *body, rigid, {nodes, static_cast<std::size_t>(std::max(count, 0))});
    });
}

int dSoftBodyDetachNodes(dSoftBodyID id, dBodyID rigid) {
    Body* body = live(id, __func__);
    if (!body || !may_edit(body->world(), __func__))
        return 0;
    if (rigid)
        return body->world().attachments().detach(*body, rigid);
    const auto held = static_cast<int>(body->pinned().size());
    body->unpin();
    return held;
}

int dSoftBodyAddForceAtNode(dSoftBodyID id, int node, dReal fx, dReal fy, dReal fz) {
    Body* body = live(id, __func__);
    if (!body)
        return 0;
    if (!has_node(*body, node, __func__))
        return 0;
    if (!all_finite({fx, fy, fz}))
        return refuse(__func__, "the force");
    body->add_force(node, {fx, fy, fz});
    return 1;
}

int dSoftBodyGetPositions(dSoftBodyID id, const dReal** first, int* stride) {
    Body* body = live(id, __func__);
    if (!body)
        return 0;
    const NodeArray& x = body->state().position;
    *first = x.data();
    *stride = NodeArray::kStride;
    return static_cast<int>(x.size());
}

int dSoftBodyGetVelocities(dSoftBodyID id, const dReal** first, int* stride) {
    Body* body = live(id, __func__);
    if (!body)
        return 0;
    const NodeArray& v = body->state().velocity;
    *first = v.data();
    *stride = NodeArray::kStride;
    return static_cast<int>(v.size());
}

int dSoftBodyGetTriangles(dSoftBodyID id, const int** first) {
    Body* body = live(id, __func__);
    if (!body)
        return 0;
    const auto& triangles = body->surface().triangle;
    *first = triangles.empty() ? nullptr : triangles.front().data();
    return static_cast<int>(triangles.size());
}

dReal dSoftBodyGetMass(dSoftBodyID id) {
    Body* body = live(id, __func__);
    if (!body)
        return 0;
    return body->total_mass();
}

void dSoftBodyGetCenterOfMass(dSoftBodyID id, dVector3 center) {
    Body* body = live(id, __func__);
    if (!body)
        return;
    Eigen::Map<Vec3>{center} = body->center_of_mass();
}

void dSoftBodyGetMomentum(dSoftBodyID id, dVector3 linear, dVector3 angular) {
    Body* body = live(id, __func__);
    if (!body)
        return;
    Eigen::Map<Vec3>{linear} = body->linear_momentum();
    Eigen::Map<Vec3>{angular} = body->angular_momentum();
}

dSoftEnergy dSoftBodyGetEnergy(dSoftBodyID id) {
    Body* body = live(id, __func__);
    if (!body)
        return {};
    return {body->kinetic_energy(), body->elastic_energy()};
}

int dSoftBodyGetStatus(dSoftBodyID id, dSoftStatus* status) {
    Body* body = live(id, __func__);
    if (!body)
        return 0;
    dSoftStatus all{};
    all.stopped = body->stopped();
    all.substep = body->substep();
    all.critical_step = body->critical_step();
    all.min_jacobian = body->extremes().min_jacobian;
    all.max_stretch = body->extremes().max_stretch;
    all.contact_points = static_cast<int>(body->bearing_points());
    all.safe_substep = body->safe_substep();
    all.energy = body->budget().energy();
    all.energy_due = body->budget().budget();
    all.rollbacks = body->rollbacks();
    all.failed_solves = body->failed_solves();
    return copy_out(__func__, all, status);
}

int dSoftBodyGetModes(dSoftBodyID id, int count, dReal* frequencies) {
    Body* body = live(id, __func__);
    if (!body)
        return 0;
    require_id(frequencies, __func__);
    return guarded(__func__, 0, [&] {
        ModalOptions options;
        options.order = body->mesh().order;
        options.mass = MassKind::kLumped; // as the body moves
        options.estimate = false;
        options.clamped.assign(body->pinned().begin(), body->pinned().end());
        options.max_modes = static_cast<std::size_t>(std::max(count, 0));
        const ModalModel modes = solve_modes(body->mesh(), body->solids(), options);
        std::copy(modes.frequency.begin(), modes.frequency.end(), frequencies);
        return static_cast<int>(modes.mode_count());
    });
}

dGeomID dSoftBodyGetGeom(dSoftBodyID id) {
    Body* body = live(id, __func__);
    if (!body)
        return nullptr;
    return body->geom();
}

dSoftBodyID dSoftGeomGetSoftBody(dGeomID geom) {
    require_id(geom, __func__);
    const Body* body = Body::behind(geom);
    return body ? to_id(*body) : nullptr;
}
