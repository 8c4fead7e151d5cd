#pragma once

#include "mesh/tet_mesh.h"
#include "modal/block_system.h"
#include "modal/modal_model.h"
#include "model/solid.h"
#include "reduced/pair_order.h"

#include <span>

namespace ode::soft {

/// What a St. Venant-Kirchhoff solid answers beyond linear elasticity to u = sum q_i phi_i of the
/// first few modes, exactly. With H = grad u, e = sym H and B the law's bilinear form, the energy
///
///     B(E, E) / 2,  E = e + H^T H / 2,
///
/// has the cubic part B(e, H^T H) / 2 and the quartic one B(H^T H, H^T H) / 8.
struct PairLoads {
    PairOrder order;
    /// One column a pair: nodal internal forces are K u + sum q_i q_j load_ij + what is cubic in u.
    /// Rows x y z of each mesh node.
    RowMatrix load;
    /// Quartic energy: p^T quartic p, p the row of products.
    Eigen::MatrixXd quartic;
};

/// By the quadrature of the explicit tier: one point in linear elements, four in quadratic ones.
/// @param kept  how many of the modes, the first ones.
PairLoads pair_loads(const TetMesh& mesh, std::span<const Solid> solids, const ModalModel& modes,
                     std::size_t kept);

} // namespace ode::soft
