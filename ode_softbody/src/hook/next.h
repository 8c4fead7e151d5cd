#pragma once

#include <dlfcn.h>

namespace ode::soft {

/// ODE's own definition of a function that this library defines too: the next one after this
/// library's in the order in which the dynamic linker looks for symbols. Where ODE lies before this
/// library there is none after it, and the first one is ODE's.
template <class Function>
Function* next_definition(const char* name, Function* own) noexcept {
    void* found = dlsym(RTLD_NEXT, name);
    if (!found)
        found = dlsym(RTLD_DEFAULT, name);
    return found == reinterpret_cast<void*>(own) ? nullptr : reinterpret_cast<Function*>(found);
}

} // namespace ode::soft
