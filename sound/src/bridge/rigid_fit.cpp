#include "bridge/rigid_fit.h"

#include "bridge/rigid_motion.h"

#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace ode::sound {
namespace {

std::string text(const char* format, ...) {
    char out[400];
    std::va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(out, sizeof out, format, arguments);
    va_end(arguments);
    return out;
}

struct Box {
    Vec3 low = Vec3::Constant(HUGE_VAL), high = Vec3::Constant(-HUGE_VAL);
    Vec3 size() const { return high - low; }
    Vec3 middle() const { return 0.5 * (low + high); }
    void hold(const Vec3& x) {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
};

/// Of all geoms that have one, world; empty where there is none, or one without end.
Box geoms_of(dBodyID body) {
    Box box;
    for (dGeomID geom = dBodyGetFirstGeom(body); geom; geom = dBodyGetNextGeom(geom)) {
        dReal aabb[6];
        dGeomGetAABB(geom, aabb);
        const Vec3 low(aabb[0], aabb[2], aabb[4]), high(aabb[1], aabb[3], aabb[5]);
        if (!low.allFinite() || !high.allFinite() || (high - low).minCoeff() < 0.0)
            continue;
        box.hold(low);
        box.hold(high);
    }
    return box;
}

} // namespace

std::string misfit(dBodyID body, const RigidModel& model) {
    dMass mass;
    dBodyGetMass(body, &mass);
    if (!(mass.mass > 0.0) || !std::isfinite(mass.mass))
        return text("the body's mass is %g kg; give it a positive one with dBodySetMass()",
                    mass.mass);
    const Box geoms = geoms_of(body);
    if (!(geoms.size().minCoeff() > 0.0))
        return {};
    const RigidMotion at(body);
    Box mesh;
    for (const Vec3& x : model.surface.nodes())
        mesh.hold(at.center + at.turn * x);
    // A geom may be rounder or plainer than its body: a capsule for a bone, a box for a die.
    constexpr double kLarger = 1.25, kOff = 0.2;
    int axis = 0;
    const double ratio = (mesh.size().cwiseQuotient(geoms.size())).maxCoeff(&axis);
    if (ratio > kLarger)
        return text("the mesh is larger than the body: %.3g m along %c, its geoms %.3g m; lengths "
                    "are metres, dSoftMeshScale() changes them",
                    mesh.size()[axis], "xyz"[axis], geoms.size()[axis]);
    const double off = (mesh.middle() - geoms.middle()).norm();
    if (off > kOff * geoms.size().norm())
        return text("the centre of mass is off: with the mesh's on the body's position, the mesh "
                    "lies %.3g m beside the body's geoms; move these by dGeomSetOffsetPosition(), "
                    "or dMassTranslate() and the body",
                    off);
    return {};
}

std::string oddity(dBodyID body, const RigidModel& model) {
    if (model.omega.empty())
        return "the mesh has no mode below 22 kHz: of the body only the click of its blows is "
               "heard";
    dMass mass;
    dBodyGetMass(body, &mass);
    constexpr double kSame = 1.25;
    if (mass.mass > kSame * model.mass || kSame * mass.mass < model.mass)
        return text("the body has %.3g kg, the mesh in its solid %.3g kg: the one moves, the other "
                    "rings; dBodySetMass() makes them equal",
                    mass.mass, model.mass);
    return {};
}

} // namespace ode::sound
