#include "hook/collision_hook.h"

#include "hook/next.h"
#include "world/other_spaces.h"
#include "world/registry.h"

#include <ode/collision.h>
#include <ode/collision_space.h>
#include <ode_softbody/export.h>

// Collision functions of ODE that this library defines too: see interposed.cpp.

namespace ode::soft {
namespace {

/// The collisions this thread is inside of, innermost first; they live on its stack. A C++
/// application's callback may throw through ODE.
class Within;
// A call to find it would cost as much as all else here: its place in a thread's memory is fixed.
[[gnu::tls_model("initial-exec")]] thread_local const Within* innermost = nullptr;

class Within {
public:
    explicit Within(dGeomID a, dGeomID b = nullptr) noexcept : a_(a), b_(b), outer_(innermost) {
        innermost = this;
    }
    ~Within() { innermost = outer_; }
    Within(const Within&) = delete;
    Within& operator=(const Within&) = delete;

    bool locks(dGeomID space) const noexcept { return a_ == space || b_ == space; }
    const Within* outer() const noexcept { return outer_; }

private:
    dGeomID a_;
    dGeomID b_;
    const Within* outer_;
};

dGeomID as_geom(dSpaceID space) noexcept { return reinterpret_cast<dGeomID>(space); }

} // namespace

bool is_locked(dSpaceID space) noexcept {
    for (; space && innermost; space = dGeomGetSpace(as_geom(space)))
        for (const Within* at = innermost; at; at = at->outer())
            if (at->locks(as_geom(space)))
                return true;
    return false;
}

} // namespace ode::soft

using namespace ode::soft;

extern "C" {

DSOFT_API void dSpaceCollide(dSpaceID space, void* data, dNearCallback* callback) {
    static const auto real = next_definition("dSpaceCollide", &dSpaceCollide);
    const Within within(as_geom(space));
    real(space, data, callback);
}

DSOFT_API void dSpaceCollide2(dGeomID a, dGeomID b, void* data, dNearCallback* callback) {
    static const auto real = next_definition("dSpaceCollide2", &dSpaceCollide2);
    const Within within(a, b);
    real(a, b, data, callback);
}

DSOFT_API void dGeomDestroy(dGeomID geom) {
    static const auto real = next_definition("dGeomDestroy", &dGeomDestroy);
    forget_space(geom);
    lose_space(geom);
    real(geom);
}

DSOFT_API void dSpaceDestroy(dSpaceID space) {
    static const auto real = next_definition("dSpaceDestroy", &dSpaceDestroy);
    forget_space(as_geom(space));
    lose_space(as_geom(space));
    real(space);
}

} // extern "C"
