#include "hook/collision_hook.h"

#include "hook/next.h"
#include "world/other_spaces.h"

#include <ode/collision.h>
#include <ode/collision_space.h>
#include <ode_softbody/export.h>

// Collision functions of ODE that this library defines too: see interposed.cpp.

namespace ode::soft {
namespace {

thread_local int depth = 0;

/// A C++ application's callback may throw through ODE.
struct Within {
    Within() noexcept { ++depth; }
    ~Within() { --depth; }
};

} // namespace

bool within_collision() noexcept { return depth > 0; }

} // namespace ode::soft

using namespace ode::soft;

extern "C" {

DSOFT_API void dSpaceCollide(dSpaceID space, void* data, dNearCallback* callback) {
    static const auto real = next_definition("dSpaceCollide", &dSpaceCollide);
    const Within within;
    real(space, data, callback);
}

DSOFT_API void dSpaceCollide2(dGeomID a, dGeomID b, void* data, dNearCallback* callback) {
    static const auto real = next_definition("dSpaceCollide2", &dSpaceCollide2);
    const Within within;
    real(a, b, data, callback);
}

DSOFT_API void dGeomDestroy(dGeomID geom) {
    static const auto real = next_definition("dGeomDestroy", &dGeomDestroy);
    forget_space(geom);
    real(geom);
}

DSOFT_API void dSpaceDestroy(dSpaceID space) {
    static const auto real = next_definition("dSpaceDestroy", &dSpaceDestroy);
    forget_space(reinterpret_cast<dGeomID>(space));
    real(space);
}

} // extern "C"
