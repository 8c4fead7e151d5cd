#include "dsp/kernels.h"

#include <cstdlib>
#include <string_view>

namespace ode::sound {
namespace baseline {
extern const Kernels kKernels;
}
namespace avx2 {
extern const Kernels kKernels;
}

const Kernels* const* all_kernels() noexcept {
#if defined(ODE_SOUND_HAS_AVX2)
    static const Kernels* const kWide[] = {&baseline::kKernels, &avx2::kKernels, nullptr};
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return kWide;
#endif
    static const Kernels* const kPortable[] = {&baseline::kKernels, nullptr};
    return kPortable;
}

const Kernels& kernels() noexcept {
    static const Kernels* const chosen = [] {
        const Kernels* const* set = all_kernels();
        const char* wish = std::getenv("ODE_SOUND_ISA");
        if (wish && std::string_view(wish) == set[0]->name)
            return set[0];
        return set[1] ? set[1] : set[0];
    }();
    return *chosen;
}

} // namespace ode::sound
