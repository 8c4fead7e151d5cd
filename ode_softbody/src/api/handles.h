#pragma once

#include "api/boundary.h"
#include "base/live_id.h"
#include "hook/step_hook.h"
#include "mesh/surface.h"
#include "mesh/tet_mesh.h"
#include "world/body.h"
#include "world/soft_world.h"

#include <ode_softbody/softbody.h>

/// A mesh is copied into the bodies made of it, so that it may go first.
struct dxSoftMesh {
    ode::soft::TetMesh mesh;
    ode::soft::Surface surface = {}; ///< once asked for
    ode::soft::LiveId<dxSoftMesh> id{*this};
};

namespace ode::soft {

/// Ids are names that only this layer resolves: one whose object has ended is told apart.

inline dSoftWorldID to_id(const SoftWorld& world) noexcept {
    return static_cast<dSoftWorldID>(world.id());
}
inline dSoftBodyID to_id(const Body& body) noexcept { return static_cast<dSoftBodyID>(body.id()); }
inline dSoftMeshID to_id(const dxSoftMesh& mesh) noexcept {
    return static_cast<dSoftMeshID>(mesh.id.value());
}

/// @return nullptr after a sentence when the object has ended. No id at all ends the program.
template <class T>
T* live_as(const void* id, const char* function, const char* what) noexcept {
    require_id(id, function);
    T* object = LiveId<T>::find(id);
    if (!object)
        report(format("%s: there is no %s %p any more; it was destroyed, or ended with its world",
                      function, what, id));
    return object;
}
inline SoftWorld* live(dSoftWorldID id, const char* function) noexcept {
    SoftWorld* world = live_as<SoftWorld>(id, function, "soft world");
    if (world && end_if_orphaned(*world)) {
        report(format("%s: the ODE world of soft world %p is gone, and so is the latter", function,
                      static_cast<void*>(id)));
        return nullptr;
    }
    return world;
}
inline Body* live(dSoftBodyID id, const char* function) noexcept {
    return live_as<Body>(id, function, "soft body");
}
inline dxSoftMesh* live(dSoftMeshID id, const char* function) noexcept {
    return live_as<dxSoftMesh>(id, function, "mesh");
}

} // namespace ode::soft
