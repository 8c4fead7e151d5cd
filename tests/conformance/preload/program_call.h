#pragma once

#include <dlfcn.h>
#include <elf.h>
#include <sys/auxv.h>

namespace ode::conformance {

/// Whether an address lies in the program itself and in none of its libraries. What the libraries
/// make for themselves (a mirror of the world, a helper's geom) is none of the program's.
inline bool in_program(const void* address) noexcept {
    Dl_info here, entry;
    return dladdr(address, &here) && dladdr(reinterpret_cast<void*>(getauxval(AT_ENTRY)), &entry) &&
           here.dli_fbase == entry.dli_fbase;
}

/// The definition of a function that comes after this library's.
template <class Function>
Function* next(const char* name) noexcept {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

} // namespace ode::conformance
