#pragma once

#include "model/damping.h"

#include <string>

namespace ode::soft {

/// What a body is solved as.
struct BodyForm {
    int order = 1;                                 ///< of its elements
    std::string model = "stvk";                    ///< one of model_names()
    bool curved = false;                           ///< curve_surface() on the promoted mesh
    std::string integrator = "central-difference"; ///< one of integrator_kinds()
    bool modal_damping = false;                    ///< ModalDamping instead of viscous stress
    DampingTable damping_table; ///< unless empty: instead of the solids' damping; modal
};

} // namespace ode::soft
