#include "reduced/residual_flexibility.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {
namespace {

constexpr Eigen::Index kAtOnce = 16;

/// Row of each mesh node's x in the system; -1: held, or in no element.
std::vector<Eigen::Index> rows_of(const ModalProblem& problem) {
    const DofMap& map = problem.map();
    std::vector<Eigen::Index> row(map.node_count(), -1);
    Eigen::Index next = 0;
    for (std::size_t i = 0; i < row.size(); ++i)
        if (problem.held()[i] != 7)
            row[i] = 3 * next++;
    std::vector<Eigen::Index> out(problem.mesh().node.size(), -1);
    for (std::size_t i = 0; i < out.size(); ++i)
        if (map.mesh_start[i + 1] - map.mesh_start[i] == 1)
            out[i] = row[static_cast<std::size_t>(
                map.mesh_term[static_cast<std::size_t>(map.mesh_start[i])].node)];
    return out;
}

} // namespace

ResidualFlexibility residual_flexibility(const TetMesh& mesh, std::span<const Solid> solids,
                                         const ModalOptions& options, const ModalModel& modes,
                                         const PushedNodes& pushed) {
    ResidualFlexibility out{std::vector<double>(mesh.node.size(), 0.0),
                            std::vector<double>(mesh.node.size(), 0.0)};
    if (modes.mode_count() == 0)
        return out;
    ModalProblem problem(mesh, solids, options);
    const std::vector<Eigen::Index> row = rows_of(problem);
    // Large against what rounding leaves of free motions, small against what is left out.
    const double shift = eigenvalue_of(modes.frequency.front());
    BlockFactor factor(problem.system());
    factor.factorise(problem.system(), shift);
    const RowMatrix& rigid = problem.rigid_motions();
    RowMatrix x;
    const auto pushes = static_cast<Eigen::Index>(2 * pushed.node.size());
    for (Eigen::Index first = 0; first < pushes; first += kAtOnce) {
        const Eigen::Index count = std::min(kAtOnce, pushes - first);
        x.setZero(problem.system().size(), count);
        const auto each = [&](auto visit) {
            for (Eigen::Index c = 0; c < count; ++c) {
                const auto push = static_cast<std::size_t>(first + c);
                const auto node = static_cast<std::size_t>(pushed.node[push / 2]);
                const Vec3& normal = pushed.normal[push / 2];
                const bool across = push % 2 != 0;
                if (row[node] >= 0)
                    visit(c, (across ? out.across : out.normal)[node], node, row[node],
                          across ? Vec3(normal.unitOrthogonal()) : normal);
            }
        };
        each([&](Eigen::Index c, double&, std::size_t, Eigen::Index r, const Vec3& n) {
            x.block<3, 1>(r, c) = n;
        });
        factor.solve(x);
        each([&](Eigen::Index c, double& yields, std::size_t node, Eigen::Index r, const Vec3& n) {
            double left = n.dot(Vec3(x.block<3, 1>(r, c)));
            for (Eigen::Index k = 0; k < rigid.cols(); ++k) {
                const double push = n.dot(Vec3(rigid.block<3, 1>(r, k)));
                left -= push * push / shift;
            }
            for (std::size_t k = 0; k < modes.mode_count(); ++k) {
                const double push = n.dot(modes.shape_at(k, node));
                left -= push * push / (eigenvalue_of(modes.frequency[k]) + shift);
            }
            yields = std::max(0.0, left);
        });
    }
    return out;
}

} // namespace ode::soft
