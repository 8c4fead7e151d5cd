// Compiled once for every instruction set.
#include "model/stvk_lanes.h"
#include "model/tet4_lanes.h"

namespace ode::soft::ODE_SOFT_ISA {

Tet4Force<StvkConstants> stvk_tet4(bool viscous);

Tet4Force<StvkConstants> stvk_tet4(bool viscous) {
    return viscous ? add_tet4_force<WideLane, Stvk, true> : add_tet4_force<WideLane, Stvk, false>;
}

} // namespace ode::soft::ODE_SOFT_ISA
