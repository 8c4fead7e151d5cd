// Compiled once for every instruction set.
#include "model/corotated_lanes.h"
#include "model/tet10_lanes.h"

namespace ode::soft::ODE_SOFT_ISA {

TetForce<CorotatedConstants> corotated_force(TetShape shape, bool viscous);

TetForce<CorotatedConstants> corotated_force(TetShape shape, bool viscous) {
    return choose_kernel<WideLane, Corotated>(shape, viscous);
}

} // namespace ode::soft::ODE_SOFT_ISA
