#pragma once

#include "base/isa.h"

#include <ctime>

namespace ode::soft {

/// CPU time of this thread [s]: other programs on the machine do not count.
inline double thread_seconds() {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

/// Floating-point operations per second that one core reaches in double at an instruction set's own
/// vector width and multiply-add, in a loop that does nothing else. Best of several tries.
double fma_peak(Isa isa);

} // namespace ode::soft
