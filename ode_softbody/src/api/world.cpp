#include "api/boundary.h"
#include "api/handles.h"
#include "api/versioned.h"
#include "hook/step_hook.h"
#include "world/registry.h"

using namespace ode::soft;

dSoftWorldID dSoftWorldCreate(dWorldID world, dSpaceID space) {
    require_id(world, __func__);
    require_id(space, __func__);
    return guarded(__func__, dSoftWorldID{}, [&] {
        SoftWorld& made = create_world(world, space);
        return to_id(made);
    });
}

void dSoftWorldDestroy(dSoftWorldID world) {
    if (world)
        destroy_world(from_id(world));
}

int dSoftWorldStep(dSoftWorldID world, dReal h, int (*step)(dWorldID, dReal)) {
    require_id(world, __func__);
    require_id(reinterpret_cast<const void*>(step), __func__);
    return from_id(world).step(h, step);
}

dReal dSoftWorldGetTime(dSoftWorldID world) {
    require_id(world, __func__);
    return from_id(world).time();
}

int dSoftWorldGetStats(dSoftWorldID id, dSoftWorldStats* out) {
    require_id(id, __func__);
    const WorldStats& stats = from_id(id).stats();
    dSoftWorldStats all{};
    all.steps = stats.steps;
    all.substeps = stats.substeps;
    all.element_steps = stats.element_steps;
    all.contact_points = stats.contact_points;
    all.contact_tests = stats.contact_tests;
    all.observer_calls = stats.observer_calls;
    all.seconds = stats.seconds;
    all.observer_seconds = stats.observer_seconds;
    return copy_out(__func__, all, out);
}
