#include "modal/rigid_motion.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>

namespace ode::soft {
namespace {

using Motion = Eigen::Matrix<double, 3, 6>; ///< of a point, by the six rigid motions

/// Rotations are divided by the part's size, so that all six move points alike.
Motion motion_at(const Vec3& arm, double size) {
    Motion m;
    m.leftCols<3>().setIdentity();
    for (int axis = 0; axis < 3; ++axis)
        m.col(3 + axis) = Vec3::Unit(axis).cross(arm) / size;
    return m;
}

} // namespace

RowMatrix free_rigid_motions(const BlockSystem& system, const std::vector<char>& held) {
    const std::vector<int> part = connected_parts(system);
    const int parts = part.empty() ? 0 : 1 + *std::max_element(part.begin(), part.end());
    std::vector<Vec3> centre(static_cast<std::size_t>(parts), Vec3::Zero());
    std::vector<double> size(static_cast<std::size_t>(parts), 0.0);
    std::vector<int> count(static_cast<std::size_t>(parts), 0);
    const auto part_of = [&](std::size_t i) { return static_cast<std::size_t>(part[i]); };
    for (std::size_t i = 0; i < part.size(); ++i) {
        centre[part_of(i)] += system.position[i];
        ++count[part_of(i)];
    }
    for (std::size_t p = 0; p < centre.size(); ++p)
        centre[p] /= count[p];
    for (std::size_t i = 0; i < part.size(); ++i)
        size[part_of(i)] =
            std::max(size[part_of(i)], (system.position[i] - centre[part_of(i)]).norm());

    std::vector<Eigen::Matrix<double, 6, 6>> support(centre.size(),
                                                     Eigen::Matrix<double, 6, 6>::Zero());
    for (std::size_t i = 0; i < part.size(); ++i) {
        const std::size_t p = part_of(i);
        const Motion m = motion_at(system.position[i] - centre[p], size[p]);
        for (int axis = 0; axis < 3; ++axis)
            if (held[i] & (1 << axis))
                support[p] += m.row(axis).transpose() * m.row(axis);
    }
    // A combination is free if it moves the supports by less than 1e-5 of the part's size per
    // unit of motion (squared here): far above rounding, far below any support meant to hold.
    std::vector<Eigen::Matrix<double, 6, Eigen::Dynamic>> kept;
    Eigen::Index columns = 0;
    for (const auto& h : support) {
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(h);
        const Eigen::Index n = (eigen.eigenvalues().array() < 1e-10).count();
        kept.emplace_back(eigen.eigenvectors().leftCols(n));
        columns += n;
    }

    // On all nodes; clamped ones rest.
    RowMatrix motions = RowMatrix::Zero(system.size(), columns);
    std::vector<Eigen::Index> first_column(kept.size(), 0);
    for (std::size_t p = 1; p < kept.size(); ++p)
        first_column[p] = first_column[p - 1] + kept[p - 1].cols();
    for (std::size_t i = 0; i < part.size(); ++i) {
        const std::size_t p = part_of(i);
        if (held[i] != 7)
            motions.block(3 * static_cast<Eigen::Index>(i), first_column[p], 3, kept[p].cols()) =
                motion_at(system.position[i] - centre[p], size[p]) * kept[p];
    }
    RowMatrix image;
    for (int pass = 0; columns > 0 && pass < 2; ++pass) { // the second removes what rounding left
        multiply_mass(system, motions, image);
        const Eigen::MatrixXd gram = motions.transpose() * image;
        const Eigen::LLT<Eigen::MatrixXd> root(gram);
        root.matrixU().solveInPlace<Eigen::OnTheRight>(motions);
    }
    Eigen::Index rows = 0;
    for (std::size_t i = 0; i < part.size(); ++i)
        if (held[i] != 7) {
            motions.middleRows(rows, 3) =
                motions.middleRows(3 * static_cast<Eigen::Index>(i), 3).eval();
            rows += 3;
        }
    motions.conservativeResize(rows, Eigen::NoChange);
    return motions;
}

} // namespace ode::soft
