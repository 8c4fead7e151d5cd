#pragma once

#include "mesh/tet_mesh.h"
#include "world/body.h"
#include "world/soft_world.h"

#include <ode_softbody/softbody.h>

/// Ids are the objects themselves under a name that only this layer resolves; a mesh is copied
/// into the bodies made of it, so that it may go first.
struct dxSoftMesh {
    ode::soft::TetMesh mesh;
};

namespace ode::soft {

inline dSoftWorldID to_id(SoftWorld& world) noexcept {
    return reinterpret_cast<dSoftWorldID>(&world);
}
inline SoftWorld& from_id(dSoftWorldID id) noexcept { return *reinterpret_cast<SoftWorld*>(id); }
inline dSoftBodyID to_id(const Body& body) noexcept {
    return reinterpret_cast<dSoftBodyID>(const_cast<Body*>(&body));
}
inline Body& from_id(dSoftBodyID id) noexcept { return *reinterpret_cast<Body*>(id); }

} // namespace ode::soft
