#include "base/isa.h"

#include "base/error.h"

#include <cstdlib>
#include <string_view>

namespace ode::soft {
namespace {

constexpr Isa kBestFirst[] = {Isa::avx512, Isa::avx2, Isa::baseline};

Isa choose() noexcept {
    const char* wanted = std::getenv("ODE_SOFTBODY_ISA");
    if (wanted != nullptr)
        for (const Isa isa : kBestFirst)
            if (isa_name(isa) == std::string_view(wanted) && is_supported(isa))
                return isa;
    Isa best = Isa::baseline;
    for (const Isa isa : kBestFirst)
        if (is_supported(isa)) {
            best = isa;
            break;
        }
    if (wanted != nullptr)
        report(format("ODE_SOFTBODY_ISA is '%s', which is not baseline, avx2 or avx512 or which "
                      "this processor lacks; using %s instead",
                      wanted, isa_name(best)));
    return best;
}

} // namespace

bool is_supported(Isa isa) noexcept {
    switch (isa) {
    case Isa::baseline:
        return true;
#if defined(__x86_64__)
    case Isa::avx2:
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    case Isa::avx512:
        return __builtin_cpu_supports("avx512f") && is_supported(Isa::avx2);
#endif
    default:
        return false;
    }
}

Isa active_isa() noexcept {
    static const Isa isa = choose();
    return isa;
}

const char* isa_name(Isa isa) noexcept {
    switch (isa) {
    case Isa::avx512:
        return "avx512";
    case Isa::avx2:
        return "avx2";
    default:
        return "baseline";
    }
}

} // namespace ode::soft
