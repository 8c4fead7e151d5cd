#pragma once

#include <stdexcept>
#include <string>

namespace ode::soft {

/// Bad input of the user's: a mesh, a material, a file. The text is one sentence that names the
/// thing, the value and the remedy. Thrown while loading only, caught in api/, never in a step.
class InputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string format(const char* text, ...);

/// Hands a sentence to ODE's message handler (dSetMessageHandler), where the application already
/// looks for trouble. Any thread that ODE may be called from.
void report(const std::string& sentence) noexcept;

} // namespace ode::soft
