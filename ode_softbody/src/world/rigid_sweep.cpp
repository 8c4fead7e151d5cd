#include "world/rigid_sweep.h"

#include "world/body.h"
#include "world/rigid_exchange.h"

#include <ode/collision.h>
#include <ode/collision_space.h>
#include <ode/objects.h>

#include <cmath>

namespace ode::soft {
namespace {

double length(const dReal* v) noexcept {
    return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/// How far a point of the geom may get in h: by its velocity, its spin, and gravity [m].
double way_of(dGeomID geom, dBodyID body, const dReal* box, double h) noexcept {
    dVector3 g;
    dWorldGetGravity(dBodyGetWorld(body), g);
    const double pull = dBodyIsKinematic(body) ? 0 : length(g) * h;
    const dReal* x = dBodyGetPosition(body);
    double arm2 = 0; // to the farthest corner of the box
    for (int i = 0; i < 3; ++i) {
        const double far =
            std::fmax(std::fabs(box[2 * i] - x[i]), std::fabs(box[2 * i + 1] - x[i]));
        arm2 += far * far;
    }
    if (dGeomGetClass(geom) == dSphereClass && !dGeomIsOffset(geom))
        arm2 = 0; // however it turns
    return h * (length(dBodyGetLinearVel(body)) + pull +
                length(dBodyGetAngularVel(body)) * std::sqrt(arm2));
}

bool overlap(const dReal* a, const dReal* b, double way) noexcept {
    for (int i = 0; i < 6; i += 2)
        if (!(a[i] - way <= b[i + 1] && b[i] <= a[i + 1] + way))
            return false;
    return true;
}

bool may_collide(dGeomID a, dGeomID b) noexcept {
    return (dGeomGetCategoryBits(a) & dGeomGetCollideBits(b)) != 0 ||
           (dGeomGetCategoryBits(b) & dGeomGetCollideBits(a)) != 0;
}

} // namespace

void sweep_rigid(dSpaceID space, double h, std::span<const std::unique_ptr<Body>> bodies,
                 RigidExchange& exchange) noexcept {
    // ODE 0.16.2 aborts a program that lists a quadtree.
    if (dGeomGetClass(reinterpret_cast<dGeomID>(space)) == dQuadTreeSpaceClass)
        return;
    const int count = dSpaceGetNumGeoms(space);
    for (int i = 0; i < count; ++i) {
        const dGeomID geom = dSpaceGetGeom(space, i);
        if (!dGeomIsEnabled(geom))
            continue;
        if (dGeomIsSpace(geom)) {
            sweep_rigid(reinterpret_cast<dSpaceID>(geom), h, bodies, exchange);
            continue;
        }
        const dBodyID body = dGeomGetBody(geom);
        if (!body || !dBodyIsEnabled(body) || dGeomGetClass(geom) == dRayClass)
            continue;
        exchange.note_awake(body);
        dReal box[6];
        dGeomGetAABB(geom, box);
        const double way = way_of(geom, body, box, h);
        for (const std::unique_ptr<Body>& soft : bodies) {
            if (!soft->geom() || soft->stopped() || !may_collide(geom, soft->geom()))
                continue;
            dReal reach[6];
            dGeomGetAABB(soft->geom(), reach);
            if (overlap(box, reach, way))
                soft->note_pair(geom);
        }
    }
}

} // namespace ode::soft
