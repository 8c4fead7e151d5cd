// Compiled once for every instruction set.
#include "model/stable_neo_hookean_lanes.h"
#include "model/tet10_lanes.h"

namespace ode::soft::ODE_SOFT_ISA {

TetForce<NeoHookeanConstants> stable_neo_hookean_force(TetShape shape, bool viscous);

TetForce<NeoHookeanConstants> stable_neo_hookean_force(TetShape shape, bool viscous) {
    return choose_kernel<WideLane, StableNeoHookean>(shape, viscous);
}

} // namespace ode::soft::ODE_SOFT_ISA
