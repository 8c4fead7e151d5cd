#pragma once

#include <ode/error.h>

#include <exception>
#include <utility>

namespace ode::sound {

/// Runs the body of an API function: an exception ends here, as a sentence through ODE's message
/// handler and the failure value.
template <class Result, class Body>
Result guarded(const char* function, Result failure, Body&& body) noexcept {
    try {
        return std::forward<Body>(body)();
    } catch (const std::exception& e) {
        dMessage(0, "%s: %s", function, e.what());
        return failure;
    }
}

/// Ends the program, in ODE's way, when the application passes no id where one is needed.
inline void require_id(const void* id, const char* function) noexcept {
    if (!id)
        dDebug(0, "%s: the id is NULL; a create function that failed has said why", function);
}

} // namespace ode::sound
