#pragma once

#include "base/isa.h"

// Dense loops over many vectors gain from wide registers and need no fused multiply-add, so that a
// function compiled twice gives the same bits both ways: ODE_SOFTBODY_AVX2 marks the wide copy.
#if defined(__x86_64__) && defined(__GNUC__)
#define ODE_SOFTBODY_AVX2 __attribute__((target("avx2")))
#define ODE_SOFTBODY_AVX512 __attribute__((target("avx512f,prefer-vector-width=512")))
#else
#define ODE_SOFTBODY_AVX2
#define ODE_SOFTBODY_AVX512
#endif

namespace ode::soft {

/// Whether the copies marked ODE_SOFTBODY_AVX2 may run.
inline bool has_avx2() { return active_isa() != Isa::baseline; }
inline bool has_avx512() { return active_isa() == Isa::avx512; }

} // namespace ode::soft
