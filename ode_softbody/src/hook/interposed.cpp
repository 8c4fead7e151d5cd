#include "hook/interposed.h"

#include "collide/soft_geom.h"
#include "hook/next.h"
#include "world/registry.h"
#include "world/soft_world.h"

#include <ode/objects.h>
#include <ode/odeinit.h>
#include <ode_softbody/export.h>

#include <algorithm>
#include <mutex>
#include <vector>

// Functions of ODE that this library defines too. Where it comes before ODE in the order in which
// the dynamic linker looks for symbols, the application's calls end here and go on to ODE; where it
// doesn't, these are never called.

namespace ode::soft {
namespace {

std::mutex lock;
std::vector<dWorldID>& made_here() {
    static std::vector<dWorldID> worlds;
    return worlds;
}

int step(dWorldID world, dReal h, RealStep real_step) noexcept {
    SoftWorld* soft = find_world(world);
    return soft ? soft->step(h, real_step) : real_step(world, h);
}

/// Where the library lies in memory.
const void* base_of(const void* address) noexcept {
    Dl_info info;
    return dladdr(address, &info) ? info.dli_fbase : nullptr;
}

} // namespace

bool steps_are_interposed(dWorldID world) {
    static const char here = 0;
    const void* first = dlsym(RTLD_DEFAULT, "dWorldStep");
    if (!first || base_of(first) != base_of(&here))
        return false;
    const std::lock_guard guard(lock);
    return std::find(made_here().begin(), made_here().end(), world) != made_here().end();
}

} // namespace ode::soft

using namespace ode::soft;

extern "C" {

DSOFT_API dWorldID dWorldCreate(void) {
    static const auto real = next_definition("dWorldCreate", &dWorldCreate);
    const dWorldID world = real();
    const std::lock_guard guard(lock);
    made_here().push_back(world);
    return world;
}

DSOFT_API int dWorldStep(dWorldID world, dReal h) {
    static const auto real = next_definition("dWorldStep", &dWorldStep);
    return step(world, h, real);
}

DSOFT_API int dWorldQuickStep(dWorldID world, dReal h) {
    static const auto real = next_definition("dWorldQuickStep", &dWorldQuickStep);
    return step(world, h, real);
}

// ODE can be told a contact but not asked: soft worlds take note of those between rigid bodies.
DSOFT_API dJointID dJointCreateContact(dWorldID world, dJointGroupID group,
                                       const dContact* contact) {
    static const auto real = next_definition("dJointCreateContact", &dJointCreateContact);
    const dJointID joint = real(world, group, contact);
    if (SoftWorld* soft = joint ? find_world(world) : nullptr)
        soft->note_contact(joint, *contact);
    return joint;
}

DSOFT_API void dWorldDestroy(dWorldID world) {
    static const auto real = next_definition("dWorldDestroy", &dWorldDestroy);
    forget_world(world);
    {
        const std::lock_guard guard(lock);
        std::erase(made_here(), world);
    }
    real(world);
}

DSOFT_API void dCloseODE(void) {
    static const auto real = next_definition("dCloseODE", &dCloseODE);
    forget_world(nullptr);
    forget_soft_class();
    real();
}

} // extern "C"
