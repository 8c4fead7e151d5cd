#include "api/boundary.h"
#include "api/editing.h"
#include "api/handles.h"
#include "api/versioned.h"
#include "hook/step_hook.h"
#include "world/registry.h"

using namespace ode::soft;

dSoftWorldID dSoftWorldCreate(dWorldID world, dSpaceID space) {
    require_id(world, __func__);
    require_id(space, __func__);
    return guarded(__func__, dSoftWorldID{}, [&] {
        if (SoftWorld* old = find_world(world)) // of an ODE world that lay here before
            end_if_orphaned(*old);
        SoftWorld& made = create_world(world, space);
        attach_hook(made);
        return to_id(made);
    });
}

void dSoftWorldDestroy(dSoftWorldID id) {
    SoftWorld* world = LiveId<SoftWorld>::find(id); // one that ended with ODE's is no mistake
    if (world && may_edit(*world, __func__))
        destroy_world(*world);
}

int dSoftWorldStep(dSoftWorldID id, dReal h, int (*step)(dWorldID, dReal)) {
    require_id(reinterpret_cast<const void*>(step), __func__);
    SoftWorld* world = live(id, __func__);
    return world ? world->step(h, step) : 0;
}

dSoftHook dSoftWorldGetHook(dSoftWorldID id) {
    const SoftWorld* world = live(id, __func__);
    switch (world ? hook_of(*world) : Hook::none) {
    case Hook::interposed:
        return dSoftHookInterposed;
    case Hook::threading:
        return dSoftHookThreading;
    case Hook::none:
        break;
    }
    return dSoftHookNone;
}

dReal dSoftWorldGetTime(dSoftWorldID id) {
    const SoftWorld* world = live(id, __func__);
    return world ? world->time() : 0;
}

int dSoftWorldGetStats(dSoftWorldID id, dSoftWorldStats* out) {
    const SoftWorld* world = live(id, __func__);
    if (!world)
        return 0;
    const WorldStats& stats = world->stats();
    dSoftWorldStats all{};
    all.steps = stats.steps;
    all.substeps = stats.substeps;
    all.element_steps = stats.element_steps;
    all.contact_points = stats.contact_points;
    all.contact_tests = stats.contact_tests;
    all.soft_pairs = stats.soft_pairs;
    all.soft_looks = stats.soft_looks;
    all.soft_tests = stats.soft_tests;
    all.body_substeps = stats.body_substeps;
    all.mirror_steps = world->exchange().mirror_steps();
    all.rigid_contacts = world->exchange().rigid_contacts();
    all.modal_substeps = world->stats().modal_substeps;
    all.observer_calls = stats.observer_calls;
    all.seconds = stats.seconds;
    all.observer_seconds = stats.observer_seconds;
    return copy_out(__func__, all, out);
}
