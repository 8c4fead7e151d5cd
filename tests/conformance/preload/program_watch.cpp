// Preloaded, this stands between the program and ODE and hands every call on. What our libraries do
// is not the program's doing and is not told.

#include "program_watch.h"

#include "program_call.h"

#include <ode/ode.h>

using namespace ode::conformance;

extern "C" {

dWorldID dWorldCreate() {
    static const auto real = next<dWorldID()>("dWorldCreate");
    const dWorldID world = real();
    if (in_program(__builtin_return_address(0)))
        on_world(world);
    return world;
}

void dWorldDestroy(dWorldID world) {
    static const auto real = next<void(dWorldID)>("dWorldDestroy");
    if (in_program(__builtin_return_address(0)))
        on_world_end(world);
    real(world);
}

dSpaceID dSimpleSpaceCreate(dSpaceID parent) {
    static const auto real = next<dSpaceID(dSpaceID)>("dSimpleSpaceCreate");
    const dSpaceID space = real(parent);
    if (in_program(__builtin_return_address(0)))
        on_space(space);
    return space;
}

dSpaceID dHashSpaceCreate(dSpaceID parent) {
    static const auto real = next<dSpaceID(dSpaceID)>("dHashSpaceCreate");
    const dSpaceID space = real(parent);
    if (in_program(__builtin_return_address(0)))
        on_space(space);
    return space;
}

dSpaceID dQuadTreeSpaceCreate(dSpaceID parent, const dVector3 centre, const dVector3 extents,
                              int depth) {
    static const auto real =
        next<dSpaceID(dSpaceID, const dReal*, const dReal*, int)>("dQuadTreeSpaceCreate");
    const dSpaceID space = real(parent, centre, extents, depth);
    if (in_program(__builtin_return_address(0)))
        on_space(space);
    return space;
}

dSpaceID dSweepAndPruneSpaceCreate(dSpaceID parent, int order) {
    static const auto real = next<dSpaceID(dSpaceID, int)>("dSweepAndPruneSpaceCreate");
    const dSpaceID space = real(parent, order);
    if (in_program(__builtin_return_address(0)))
        on_space(space);
    return space;
}

void dSpaceDestroy(dSpaceID space) {
    static const auto real = next<void(dSpaceID)>("dSpaceDestroy");
    real(space);
    if (in_program(__builtin_return_address(0)))
        on_space_end(space);
}

void dBodySetPosition(dBodyID body, dReal x, dReal y, dReal z) {
    static const auto real = next<void(dBodyID, dReal, dReal, dReal)>("dBodySetPosition");
    if (in_program(__builtin_return_address(0)))
        on_body_placed(dBodyGetWorld(body));
    real(body, x, y, z);
}

void dSpaceCollide(dSpaceID space, void* data, dNearCallback* callback) {
    static const auto real = next<void(dSpaceID, void*, dNearCallback*)>("dSpaceCollide");
    if (in_program(__builtin_return_address(0)))
        on_collide(space);
    real(space, data, callback);
}

void dCloseODE() {
    static const auto real = next<void()>("dCloseODE");
    real();
    if (in_program(__builtin_return_address(0)))
        on_closed();
}

} // extern "C"
