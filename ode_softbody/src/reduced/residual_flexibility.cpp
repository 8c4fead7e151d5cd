#include "reduced/residual_flexibility.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {
std::vector<ResidualFlexibility>
residual_flexibility(const TetMesh& mesh, std::span<const Solid> solids,
                     const ModalOptions& options, const ModalModel& modes,
                     const PushedNodes& pushed, std::span<const std::size_t> kept) {
    std::vector<ResidualFlexibility> out(kept.size(), {std::vector<double>(mesh.node.size(), 0.0),
                                                       std::vector<double>(mesh.node.size(), 0.0)});
    if (modes.mode_count() == 0)
        return out;
    ModalProblem problem(mesh, solids, options);
    const std::vector<Eigen::Index> row = problem.mesh_rows();
    // Large against what rounding leaves of free motions, small against what is left out.
    const double shift = eigenvalue_of(modes.frequency.front());
    BlockFactor factor(problem.system());
    factor.factorise(problem.system(), shift);
    const RowMatrix& rigid = problem.rigid_motions();
    const std::vector<Eigen::Matrix3d> inverse = factor.inverse_diagonal();
    for (std::size_t p = 0; p < pushed.node.size(); ++p) {
        const auto node = static_cast<std::size_t>(pushed.node[p]);
        const Eigen::Index r = row[node];
        if (r < 0)
            continue;
        const auto measure = [&](const Vec3& n, auto place) {
            double left = n.dot(inverse[static_cast<std::size_t>(r / 3)] * n);
            for (Eigen::Index k = 0; k < rigid.cols(); ++k) {
                const double push = n.dot(Vec3(rigid.block<3, 1>(r, k)));
                left -= push * push / shift;
            }
            std::size_t k = 0;
            for (std::size_t i = 0; i < kept.size(); ++i) {
                for (; k < kept[i]; ++k) {
                    const double push = n.dot(modes.shape_at(k, node));
                    left -= push * push / (eigenvalue_of(modes.frequency[k]) + shift);
                }
                (out[i].*place)[node] = std::max(0.0, left);
            }
        };
        measure(pushed.normal[p], &ResidualFlexibility::normal);
        measure(pushed.normal[p].unitOrthogonal(), &ResidualFlexibility::across);
    }
    return out;
}

} // namespace ode::soft
