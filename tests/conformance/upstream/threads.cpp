// Demos that step their world with a pool of threads solve its islands' rows in an order of chance.
// One thread makes them repeat:
//
//   CONFORMANCE_THREADS  threads of each pool; default 1

#include "../preload/program_call.h"

#include <ode/ode.h>
#include <ode/threading_impl.h>

#include <cstdlib>

extern "C" dThreadingThreadPoolID dThreadingAllocateThreadPool(unsigned, dsizeint stack_size,
                                                               unsigned ode_data, void* reserved) {
    static const auto real =
        ode::conformance::next<dThreadingThreadPoolID(unsigned, dsizeint, unsigned, void*)>(
            "dThreadingAllocateThreadPool");
    const char* wanted = std::getenv("CONFORMANCE_THREADS");
    return real(wanted ? static_cast<unsigned>(std::atoi(wanted)) : 1, stack_size, ode_data,
                reserved);
}
