#include "reduced/cubic_rows.h"

#include "base/isa.h"

namespace ode::soft {

namespace baseline {
AddRows add_rows();
}
#if defined(__x86_64__)
namespace avx2 {
AddRows add_rows();
}
namespace avx512 {
AddRows add_rows();
}
#endif

AddRows add_rows_kernel() noexcept {
#if defined(__x86_64__)
    switch (active_isa()) {
    case Isa::avx512:
        return avx512::add_rows();
    case Isa::avx2:
        return avx2::add_rows();
    case Isa::baseline:
        break;
    }
#endif
    return baseline::add_rows();
}

} // namespace ode::soft
