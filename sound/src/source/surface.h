#pragma once

#include "dsp/storage.h"

#include <span>
#include <vector>

namespace ode::sound {

/// A moving surface at the end of a substep. Borrowed: it dies on return.
struct SurfaceView {
    double time;            ///< [s]
    double dt;              ///< [s]
    const double* position; ///< of all nodes of the body [m]
    const double* velocity; ///< of all nodes of the body [m/s], half a substep back
    int stride;             ///< doubles from node to node: 4 or more, the fourth readable
};

/// Which nodes of a body carry its surface, and how triangles join them.
///
/// Nodes are numbered anew, in the body's order, so that the loops touch the surface alone. Their
/// count is rounded up to a multiple of four by repeating the last one, which then bears no area.
class Surface {
public:
    /// @param triangle  three nodes of the body each, outward.
    explicit Surface(std::span<const int> triangle);

    int nodes() const noexcept { return static_cast<int>(body_node_.size()); }
    int real_nodes() const noexcept { return real_nodes_; }
    int triangles() const noexcept { return static_cast<int>(triangle_.size() / 3); }
    const int* body_node() const noexcept { return body_node_.data(); } ///< nodes() of them
    const int* triangle() const noexcept { return triangle_.data(); }   ///< in surface numbers

    /// Positions as points (x y z 0).
    void collect(const double* body_points, int stride, double* point) const noexcept;

    /// Area vector of every node: a third of its triangles', points [m^2]. With A_t the sum over a
    /// triangle and d the displacements of its nodes, sum A_i . d_i = sum A_t . mean(d): the
    /// volume that the surface sweeps, to first order.
    void areas(const double* point, double* area) const noexcept;

private:
    int real_nodes_ = 0;
    std::vector<int> body_node_;
    std::vector<int> triangle_;
};

} // namespace ode::sound
