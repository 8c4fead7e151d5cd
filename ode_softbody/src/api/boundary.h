#pragma once

#include "base/error.h"

#include <ode/error.h>

#include <exception>
#include <new>
#include <utility>

namespace ode::soft {

/// Runs the body of a C function that may throw: the one place where exceptions end. A failure is
/// told through dMessage and becomes `failure`.
template <class Function, class Result>
Result guarded(const char* function, Result failure, Function&& body) noexcept {
    try {
        return std::forward<Function>(body)();
    } catch (const std::bad_alloc&) {
        report(format("%s: out of memory", function));
    } catch (const std::exception& e) {
        report(format("%s: %s", function, e.what()));
    }
    return failure;
}

/// Ends the program, in ODE's way, when the application passes no id where one is needed.
inline void require_id(const void* id, const char* function) noexcept {
    if (!id)
        dDebug(0, "%s: the id is NULL; a create function that failed has said why", function);
}

} // namespace ode::soft
