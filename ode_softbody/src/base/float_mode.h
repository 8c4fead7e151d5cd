#pragma once

#include <cfenv>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace ode::soft {

/// How a thread rounds and whether denormal numbers are flushed to zero: applications set it, audio
/// code above all, and a result that must not depend on the thread must not depend on this.
class FloatMode {
public:
#if defined(__SSE__)
    static FloatMode of_this_thread() noexcept { return FloatMode(_mm_getcsr() & ~kFlags); }
    /// @return what held before.
    FloatMode apply() const noexcept {
        const FloatMode before = of_this_thread();
        if (before.bits_ != bits_)
            _mm_setcsr(bits_);
        return before;
    }

private:
    explicit FloatMode(unsigned bits) noexcept : bits_(bits) {}
    static constexpr unsigned kFlags = 0x3f; ///< what has happened, not what is wanted
    unsigned bits_;
#else
    static FloatMode of_this_thread() noexcept {
        FloatMode mode;
        std::fegetenv(&mode.environment_);
        return mode;
    }
    FloatMode apply() const noexcept {
        const FloatMode before = of_this_thread();
        std::fesetenv(&environment_);
        return before;
    }

private:
    FloatMode() = default;
    std::fenv_t environment_;
#endif
};

} // namespace ode::soft
