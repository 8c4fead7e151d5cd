#include "api/boundary.h"
#include "api/handles.h"
#include "api/solid.h"
#include "api/versioned.h"
#include "modal/solve_modes.h"

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
    require_id(world, __func__);
    require_id(mesh, __func__);
    require_id(solid, __func__);
    return guarded(__func__, dSoftBodyID{}, [&] {
        const Solid one = from_c(*solid);
        return to_id(from_id(world).create_body(mesh->mesh, {&one, 1}));
    });
}

void dSoftBodyDestroy(dSoftBodyID id) {
    if (id)
        from_id(id).world().destroy_body(from_id(id));
}

void dSoftBodySetData(dSoftBodyID id, void* data) {
    require_id(id, __func__);
    from_id(id).data = data;
}

void* dSoftBodyGetData(dSoftBodyID id) {
    require_id(id, __func__);
    return from_id(id).data;
}

int dSoftBodySetSubstep(dSoftBodyID id, dReal dt) {
    require_id(id, __func__);
    Body& body = from_id(id);
    if (dt == 0) {
        body.use_default_substep();
        return 1;
    }
    if (!(dt > 0 && std::isfinite(dt) && dt <= body.longest_substep())) {
        report(
            format("dSoftBodySetSubstep: %g s is outside (0, %g s], the stable range of this body; "
                   "give 0 to let the library choose",
                   dt, body.longest_substep()));
        return 0;
    }
    body.set_substep(dt);
    return 1;
}

dReal dSoftBodyGetSubstep(dSoftBodyID id) {
    require_id(id, __func__);
    return from_id(id).substep();
}

dReal dSoftBodyGetCriticalStep(dSoftBodyID id) {
    require_id(id, __func__);
    return from_id(id).critical_step();
}

int dSoftBodySetPosition(dSoftBodyID id, dReal x, dReal y, dReal z) {
    require_id(id, __func__);
    if (!all_finite({x, y, z}))
        return refuse(__func__, "the position");
    from_id(id).move_to({x, y, z});
    return 1;
}

int dSoftBodyRotate(dSoftBodyID id, const dQuaternion q) {
    require_id(id, __func__);
    const Quat rotation(q[0], q[1], q[2], q[3]);
    constexpr double kUnit = 1e-6; // a quaternion from ODE is normalised to rounding
    if (!(std::abs(rotation.norm() - 1) < kUnit)) {
        report(
            format("dSoftBodyRotate: the quaternion has length %g; normalise it", rotation.norm()));
        return 0;
    }
    from_id(id).rotate(rotation.normalized());
    return 1;
}

int dSoftBodySetLinearVel(dSoftBodyID id, dReal x, dReal y, dReal z) {
    require_id(id, __func__);
    if (!all_finite({x, y, z}))
        return refuse(__func__, "the velocity");
    from_id(id).set_velocity({x, y, z});
    return 1;
}

int dSoftBodyAddAngularVel(dSoftBodyID id, dReal x, dReal y, dReal z) {
    require_id(id, __func__);
    if (!all_finite({x, y, z}))
        return refuse(__func__, "the angular velocity");
    from_id(id).add_spin({x, y, z});
    return 1;
}

int dSoftBodyPinNodes(dSoftBodyID id, const int* nodes, int count) {
    require_id(id, __func__);
    Body& body = from_id(id);
    for (int i = 0; i < count; ++i)
        if (!has_node(body, nodes[i], __func__))
            return 0;
    return guarded(__func__, 0, [&] {
        body.pin({nodes, static_cast<std::size_t>(std::max(count, 0))});
        return static_cast<int>(body.pinned().size());
    });
}

void dSoftBodyUnpin(dSoftBodyID id) {
    require_id(id, __func__);
    from_id(id).unpin();
}

int dSoftBodyAddForceAtNode(dSoftBodyID id, int node, dReal fx, dReal fy, dReal fz) {
    require_id(id, __func__);
    Body& body = from_id(id);
    if (!has_node(body, node, __func__))
        return 0;
    if (!all_finite({fx, fy, fz}))
        return refuse(__func__, "the force");
    body.add_force(node, {fx, fy, fz});
    return 1;
}

int dSoftBodyGetPositions(dSoftBodyID id, const dReal** first, int* stride) {
    require_id(id, __func__);
    const NodeArray& x = from_id(id).state().position;
    *first = x.data();
    *stride = NodeArray::kStride;
    return static_cast<int>(x.size());
}

int dSoftBodyGetVelocities(dSoftBodyID id, const dReal** first, int* stride) {
    require_id(id, __func__);
    const NodeArray& v = from_id(id).state().velocity;
    *first = v.data();
    *stride = NodeArray::kStride;
    return static_cast<int>(v.size());
}

int dSoftBodyGetTriangles(dSoftBodyID id, const int** first) {
    require_id(id, __func__);
    const auto& triangles = from_id(id).surface().triangle;
    *first = triangles.empty() ? nullptr : triangles.front().data();
    return static_cast<int>(triangles.size());
}

dReal dSoftBodyGetMass(dSoftBodyID id) {
    require_id(id, __func__);
    return from_id(id).total_mass();
}

void dSoftBodyGetCenterOfMass(dSoftBodyID id, dVector3 center) {
    require_id(id, __func__);
    Eigen::Map<Vec3>{center} = from_id(id).center_of_mass();
}

void dSoftBodyGetMomentum(dSoftBodyID id, dVector3 linear, dVector3 angular) {
    require_id(id, __func__);
    Eigen::Map<Vec3>{linear} = from_id(id).linear_momentum();
    Eigen::Map<Vec3>{angular} = from_id(id).angular_momentum();
}

dSoftEnergy dSoftBodyGetEnergy(dSoftBodyID id) {
    require_id(id, __func__);
    return {from_id(id).kinetic_energy(), from_id(id).elastic_energy()};
}

int dSoftBodyGetStatus(dSoftBodyID id, dSoftStatus* status) {
    require_id(id, __func__);
    const Body& body = from_id(id);
    dSoftStatus all{};
    all.stopped = body.stopped();
    all.substep = body.substep();
    all.critical_step = body.critical_step();
    all.min_jacobian = body.extremes().min_jacobian;
    all.max_stretch = body.extremes().max_stretch;
    all.contact_points = static_cast<int>(body.bearing_points());
    return copy_out(__func__, all, status);
}

int dSoftBodyGetModes(dSoftBodyID id, int count, dReal* frequencies) {
    require_id(id, __func__);
    require_id(frequencies, __func__);
    return guarded(__func__, 0, [&] {
        const Body& body = from_id(id);
        ModalOptions options;
        options.order = body.mesh().order;
        options.mass = MassKind::kLumped; // as the body moves
        options.estimate = false;
        options.clamped.assign(body.pinned().begin(), body.pinned().end());
        options.max_modes = static_cast<std::size_t>(std::max(count, 0));
        const ModalModel modes = solve_modes(body.mesh(), body.solids(), options);
        std::copy(modes.frequency.begin(), modes.frequency.end(), frequencies);
        return static_cast<int>(modes.mode_count());
    });
}

dGeomID dSoftBodyGetGeom(dSoftBodyID id) {
    require_id(id, __func__);
    return from_id(id).geom();
}

dSoftBodyID dSoftGeomGetSoftBody(dGeomID geom) {
    require_id(geom, __func__);
    const Body* body = Body::behind(geom);
    return body ? to_id(*body) : nullptr;
}

dSoftContact dSoftContactDefault(void) {
    const ContactLaw law;
    dSoftContact contact{};
    contact.struct_size = sizeof contact;
    contact.friction = law.friction;
    contact.stiffness = law.stiffness;
    contact.damping = law.damping;
    return contact;
}

int dSoftBodySetContact(dSoftBodyID id, const dSoftContact* contact) {
    require_id(id, __func__);
    require_id(contact, __func__);
    return guarded(__func__, 0, [&] {
        dSoftContact c = dSoftContactDefault();
        copy_in(*contact, "dSoftContactDefault", &c);
        if (!(c.friction >= 0 && c.stiffness >= 0 && c.damping >= 0 && std::isfinite(c.stiffness) &&
              std::isfinite(c.damping)))
            throw InputError(
                format("friction %g, stiffness %g Pa/m or damping %g s is negative or not "
                       "a number; give values of at least 0",
                       c.friction, c.stiffness, c.damping));
        from_id(id).set_contact_law({c.friction, c.stiffness, c.damping});
        return 1;
    });
}
