#include "base/error.h"

#include <ode/error.h>

#include <cstdarg>
#include <cstdio>

namespace ode::soft {

std::string format(const char* text, ...) {
    va_list arguments;
    va_start(arguments, text);
    va_list again;
    va_copy(again, arguments);
    const int length = std::vsnprintf(nullptr, 0, text, arguments);
    va_end(arguments);
    std::string out(length > 0 ? static_cast<std::size_t>(length) : 0, '\0');
    std::vsnprintf(out.data(), out.size() + 1, text, again);
    va_end(again);
    return out;
}

void report(const std::string& sentence) noexcept { dMessage(0, "%s", sentence.c_str()); }

} // namespace ode::soft
