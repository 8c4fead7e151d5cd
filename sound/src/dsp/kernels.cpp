#include "dsp/kernels.h"

#include <cstdlib>
#include <string_view>

namespace ode::sound {
namespace baseline {
extern const Kernels kKernels;
}
#if defined(ODE_SOUND_X86)
namespace avx2 {
extern const Kernels kKernels;
}
namespace avx512 {
extern const Kernels kKernels;
}
#endif

std::span<const Kernels* const> all_kernels() noexcept {
#if defined(ODE_SOUND_X86)
    static const Kernels* const kAll[] = {&baseline::kKernels, &avx2::kKernels, &avx512::kKernels};
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    const bool avx512 = avx2 && __builtin_cpu_supports("avx512f");
    return {kAll, avx512 ? 3u : avx2 ? 2u : 1u};
#else
    static const Kernels* const kAll[] = {&baseline::kKernels};
    return kAll;
#endif
}

const Kernels& kernels() noexcept {
    static const Kernels* const chosen = [] {
        const std::span<const Kernels* const> all = all_kernels();
        if (const char* wish = std::getenv("ODE_SOUND_ISA"))
            for (const Kernels* set : all)
                if (std::string_view(wish) == set->name)
                    return set;
        return all.back();
    }();
    return *chosen;
}

} // namespace ode::sound
