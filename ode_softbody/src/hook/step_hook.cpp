#include "hook/step_hook.h"

#include "collide/soft_geom.h"
#include "world/registry.h"
#include "world/soft_world.h"

#include <ode/objects.h>
#include <ode/odeinit.h>
#include <ode_softbody/export.h>

#include <dlfcn.h>

// Functions of ODE that this library defines too. Where it comes before ODE in the order in which
// the dynamic linker looks for symbols, the application's calls end here and go on to ODE; where it
// doesn't, these are never called.

namespace ode::soft {
namespace {

/// ODE's own definition: the next one after this library's.
template <class Function>
Function* next(const char* name) noexcept {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
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

bool steps_are_interposed() noexcept {
    static const char here = 0;
    const void* first = dlsym(RTLD_DEFAULT, "dWorldStep");
    return first && base_of(first) == base_of(&here);
}

} // namespace ode::soft

using namespace ode::soft;

extern "C" {

DSOFT_API int dWorldStep(dWorldID world, dReal h) {
    static const RealStep real = next<int(dWorldID, dReal)>("dWorldStep");
    return step(world, h, real);
}

DSOFT_API int dWorldQuickStep(dWorldID world, dReal h) {
    static const RealStep real = next<int(dWorldID, dReal)>("dWorldQuickStep");
    return step(world, h, real);
}

DSOFT_API void dWorldDestroy(dWorldID world) {
    static const auto real = next<void(dWorldID)>("dWorldDestroy");
    forget_world(world);
    real(world);
}

DSOFT_API void dCloseODE(void) {
    static const auto real = next<void()>("dCloseODE");
    forget_world(nullptr);
    forget_soft_class();
    real();
}

} // extern "C"
