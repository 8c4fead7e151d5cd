#pragma once

namespace ode::soft {

/// Instruction sets that the force kernels are compiled for.
enum class Isa {
    baseline, ///< what the platform guarantees: SSE2 on x86-64; no fused multiply-add
    avx2,     ///< AVX2 with FMA
    avx512,   ///< AVX-512 F
};

/// Whether this processor and this build have it.
bool is_supported(Isa isa) noexcept;

/// What models use unless told otherwise: the best supported, or the one that the environment
/// variable ODE_SOFTBODY_ISA (baseline, avx2, avx512) names. Decided at the first call; any thread.
/// avx2 and avx512 give the same bits, baseline differs by rounding.
Isa active_isa() noexcept;

const char* isa_name(Isa isa) noexcept;

} // namespace ode::soft
