#include "model/stvk_linear.h"
#include "model/stvk_quadratic.h"
#include "model/tet_model_impl.h"

namespace ode::soft {

namespace baseline {
TetForce<StvkConstants> stvk_force(TetShape shape, bool viscous);
}
#if defined(__x86_64__)
namespace avx2 {
TetForce<StvkConstants> stvk_force(TetShape shape, bool viscous);
}
namespace avx512 {
TetForce<StvkConstants> stvk_force(TetShape shape, bool viscous);
}
#endif

TetForce<StvkConstants> StvkLaw::kernel(Isa isa, TetShape shape, bool viscous) noexcept {
    switch (isa) {
#if defined(__x86_64__)
    case Isa::avx512:
        return avx512::stvk_force(shape, viscous);
    case Isa::avx2:
        return avx2::stvk_force(shape, viscous);
#endif
    default:
        return baseline::stvk_force(shape, viscous);
    }
}

template class TetModel<StvkLaw, Tet4Packs>;
template class TetModel<StvkLaw, Tet10Packs>;

} // namespace ode::soft
