#pragma once

#include "base/error.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace ode::soft {

/// Structs of the public API carry their size, so that an application compiled against an older
/// header keeps working when fields are appended: only what it knows is read or written.

/// @return 0 after a sentence when the application left struct_size unset.
template <class Struct>
int copy_out(const char* function, const Struct& from, Struct* to) noexcept {
    if (to->struct_size < sizeof(unsigned)) {
        report(format("%s: struct_size is %u; set it to the size of the struct before the call",
                      function, to->struct_size));
        return 0;
    }
    const std::size_t size = std::min<std::size_t>(to->struct_size, sizeof(Struct));
    std::memcpy(reinterpret_cast<char*>(to) + sizeof(unsigned),
                reinterpret_cast<const char*>(&from) + sizeof(unsigned), size - sizeof(unsigned));
    return 1;
}

/// Fields that the application doesn't know keep the value they have in `to`.
/// @throws InputError naming the function that makes the default.
template <class Struct>
void copy_in(const Struct& from, const char* default_function, Struct* to) {
    if (from.struct_size < sizeof(unsigned))
        throw InputError(
            format("struct_size is %u; start from %s()", from.struct_size, default_function));
    std::memcpy(to, &from, std::min<std::size_t>(from.struct_size, sizeof(Struct)));
}

} // namespace ode::soft
