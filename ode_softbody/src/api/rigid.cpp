#include "api/boundary.h"
#include "api/handles.h"
#include "api/versioned.h"
#include "collide/body_watch.h"
#include "world/registry.h"

struct dxSoftRigidWatch {
    explicit dxSoftRigidWatch(dBodyID body) : watch(body) {}
    ode::soft::BodyWatch watch;
    ode::soft::LiveId<dxSoftRigidWatch> id{*this};
};

using namespace ode::soft;

dSoftWorldID dSoftWorldFind(dWorldID world) {
    require_id(world, __func__);
    const SoftWorld* found = find_world(world);
    return found ? to_id(*found) : nullptr;
}

int dSoftWorldGetRigidContact(dSoftWorldID id, dJointID joint, dSoftRigidContact* out) {
    require_id(joint, __func__);
    require_id(out, __func__);
    const SoftWorld* world = live(id, __func__);
    const dContact* found = world ? world->find_contact(joint) : nullptr;
    if (!found)
        return 0;
    dSoftRigidContact all{};
    for (int i = 0; i < 3; ++i) {
        all.position[i] = found->geom.pos[i];
        all.normal[i] = found->geom.normal[i];
    }
    all.depth = found->geom.depth;
    all.geom[0] = found->geom.g1;
    all.geom[1] = found->geom.g2;
    all.friction = found->surface.mu;
    return copy_out(__func__, all, out);
}

dSoftRigidWatchID dSoftRigidWatchCreate(dBodyID body) {
    require_id(body, __func__);
    return guarded(__func__, dSoftRigidWatchID{}, [&] {
        return static_cast<dSoftRigidWatchID>((new dxSoftRigidWatch(body))->id.value());
    });
}

void dSoftRigidWatchDestroy(dSoftRigidWatchID id) { delete LiveId<dxSoftRigidWatch>::find(id); }

int dSoftRigidWatchIsGone(dSoftRigidWatchID id) {
    const auto* watch = live_as<dxSoftRigidWatch>(id, __func__, "watch of a rigid body");
    return !watch || watch->watch.gone();
}
