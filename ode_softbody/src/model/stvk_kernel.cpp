// Compiled once for every instruction set.
#include "model/stvk_lanes.h"
#include "model/tet10_lanes.h"

namespace ode::soft::ODE_SOFT_ISA {

TetForce<StvkConstants> stvk_force(TetShape shape, bool viscous);

TetForce<StvkConstants> stvk_force(TetShape shape, bool viscous) {
    return choose_kernel<WideLane, Stvk>(shape, viscous);
}

} // namespace ode::soft::ODE_SOFT_ISA
