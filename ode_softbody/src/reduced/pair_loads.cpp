#include "reduced/pair_loads.h"

#include "model/tet10_shape.h"
#include "model/tet_kernel.h"

#include <Eigen/LU>

#include <cmath>
#include <vector>

namespace ode::soft {
namespace {

using Eigen::Index;

/// Derivatives of an element's shapes at its points, and the points' shares of its volume.
struct Points {
    int count = 0;
    Eigen::Matrix<double, Eigen::Dynamic, 3> gradient[4]; ///< one row a node [1/m]
    double volume[4];                                     ///< [m^3]
};

Points points_of(const TetMesh& mesh, std::size_t e) {
    const auto node = mesh.nodes_of(e);
    const auto at = [&](Index a) -> const Vec3& {
        return mesh.node[static_cast<std::size_t>(node[static_cast<std::size_t>(a)])];
    };
    Points out;
    const auto add = [&](const auto& by_corner, double share) {
        Mat3 jacobian = Mat3::Zero();
        for (Index a = 0; a < by_corner.rows(); ++a)
            jacobian += (at(a) - at(0)) * by_corner.row(a);
        out.gradient[out.count] = by_corner * jacobian.inverse();
        out.volume[out.count++] = share * jacobian.determinant();
    };
    if (mesh.order == 1) {
        Eigen::Matrix<double, 4, 3> corner;
        corner << -1, -1, -1, 1, 0, 0, 0, 1, 0, 0, 0, 1;
        add(corner, 1.0 / 6);
        return out;
    }
    for (int q = 0; q < 4; ++q) {
        Eigen::Vector4d l = Eigen::Vector4d::Constant(kGaussFar);
        l[q] = kGaussNear;
        add(tet10_gradients(l), 1.0 / 24);
    }
    return out;
}

/// At one point: the modes' gradients and linear stresses, and what pairs of them make.
class PointProducts {
public:
    explicit PointProducts(PairOrder order)
        : order_(order), h_(9, order.modes), s_(9, order.modes), force_(9, order.count()),
          strain_(7, order.count()) {}

    /// @param shape  of the element's nodes: x y z rows of one column a mode.
    void take(const Eigen::MatrixXd& shape, const Eigen::Matrix<double, Eigen::Dynamic, 3>& by,
              const Solid& solid) {
        const double lambda = solid.lambda(), mu = solid.mu();
        h_.setZero();
        for (Index a = 0; a < by.rows(); ++a)
            for (int r = 0; r < 3; ++r)
                for (int c = 0; c < 3; ++c)
                    h_.row(3 * r + c) += by(a, c) * shape.row(3 * a + r);
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c)
                s_.row(3 * r + c) = mu * (h_.row(3 * r + c) + h_.row(3 * c + r));
        const Eigen::RowVectorXd pressure = lambda * (h_.row(0) + h_.row(4) + h_.row(8));
        for (int r = 0; r < 3; ++r)
            s_.row(4 * r) += pressure;
        for (std::size_t j = 0; j < order_.modes; ++j)
            pair_with(static_cast<Index>(j), lambda, mu);
    }
    /// Nine rows: H S' + H' S + C : sym(H^T H'), the first Piola-Kirchhoff stress of each pair.
    const RowMatrix& force() const { return force_; }
    /// Seven rows whose squares, summed, are B(H^T H, H^T H).
    const RowMatrix& strain() const { return strain_; }

private:
    void pair_with(Index j, double lambda, double mu) {
        const auto first = static_cast<Index>(PairOrder::at(0, static_cast<std::size_t>(j)));
        const Index many = j + 1;
        const auto h = [&](int r, int c) { return h_.row(3 * r + c).head(many).array(); };
        const auto s = [&](int r, int c) { return s_.row(3 * r + c).head(many).array(); };
        const auto hj = [&](int r, int c) { return h_(3 * r + c, j); };
        const auto sj = [&](int r, int c) { return s_(3 * r + c, j); };
        // H_i^T H_j + H_j^T H_i; of a mode with itself half of that.
        Eigen::Array<double, 6, Eigen::Dynamic, Eigen::RowMajor> g(6, many);
        constexpr int kPlace[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
        for (int r = 0; r < 3; ++r)
            for (int c = r; c < 3; ++c) {
                auto row = g.row(kPlace[r][c]);
                row = hj(0, r) * h(0, c) + h(0, r) * hj(0, c);
                row += hj(1, r) * h(1, c) + h(1, r) * hj(1, c);
                row += hj(2, r) * h(2, c) + h(2, r) * hj(2, c);
            }
        g.col(j) *= 0.5;
        const Eigen::Array<double, 1, Eigen::Dynamic> trace = g.row(0) + g.row(1) + g.row(2);
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c) {
                Eigen::Array<double, 1, Eigen::Dynamic> p(many);
                p.setZero();
                for (int m = 0; m < 3; ++m)
                    p += hj(r, m) * s(m, c) + h(r, m) * sj(m, c);
                p[j] *= 0.5;                   // itself: H S once
                p += mu * g.row(kPlace[r][c]); // C : H^T H / 2, of which g holds the H^T H
                if (r == c)
                    p += lambda / 2 * trace;
                force_.row(3 * r + c).segment(first, many) = p.matrix();
            }
        const double volume_like = std::sqrt(lambda + 2 * mu / 3), shear_like = std::sqrt(2 * mu);
        strain_.row(0).segment(first, many) = (volume_like * trace).matrix();
        for (int r = 0; r < 3; ++r)
            strain_.row(1 + r).segment(first, many) =
                (shear_like * (g.row(r) - trace / 3)).matrix();
        for (int r = 3; r < 6; ++r)
            strain_.row(1 + r).segment(first, many) =
                (std::sqrt(2.0) * shear_like * g.row(r)).matrix();
    }

    PairOrder order_;
    RowMatrix h_, s_;
    RowMatrix force_, strain_;
};

} // namespace

PairLoads pair_loads(const TetMesh& mesh, std::span<const Solid> solids, const ModalModel& modes,
                     std::size_t kept) {
    PairLoads out;
    out.order.modes = kept;
    const auto pairs = static_cast<Index>(out.order.count());
    out.load = RowMatrix::Zero(3 * static_cast<Index>(mesh.node.size()), pairs);
    out.quartic = Eigen::MatrixXd::Zero(pairs, pairs);
    PointProducts products(out.order);
    const Index nodes = mesh.nodes_per_element();
    Eigen::MatrixXd shape(3 * nodes, static_cast<Index>(kept));
    constexpr Index kBatch = 64; // points whose strains are multiplied at once
    RowMatrix strain(7 * kBatch, pairs);
    Index held = 0;
    const auto flush = [&] {
        if (held == 0) // Eigen divides by it
            return;
        const auto some = strain.topRows(7 * held);
        out.quartic.selfadjointView<Eigen::Lower>().rankUpdate(some.transpose(), 0.125);
        held = 0;
    };
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        const auto node = mesh.nodes_of(e);
        for (Index a = 0; a < nodes; ++a)
            for (std::size_t k = 0; k < kept; ++k)
                shape.block<3, 1>(3 * a, static_cast<Index>(k)) =
                    modes.shape_at(k, static_cast<std::size_t>(node[static_cast<std::size_t>(a)]));
        const Points points = points_of(mesh, e);
        const Solid& solid =
            solids[mesh.group.empty() ? 0 : static_cast<std::size_t>(mesh.group[e])];
        for (int q = 0; q < points.count; ++q) {
            products.take(shape, points.gradient[q], solid);
            for (Index a = 0; a < nodes; ++a) {
                const Index row = 3 * node[static_cast<std::size_t>(a)];
                for (int r = 0; r < 3; ++r)
                    for (int c = 0; c < 3; ++c)
                        out.load.row(row + r) += (points.volume[q] * points.gradient[q](a, c)) *
                                                 products.force().row(3 * r + c);
            }
            strain.middleRows(7 * held, 7) = std::sqrt(points.volume[q]) * products.strain();
            if (++held == kBatch)
                flush();
        }
    }
    flush();
    out.quartic.triangularView<Eigen::StrictlyUpper>() = out.quartic.transpose();
    return out;
}

} // namespace ode::soft
