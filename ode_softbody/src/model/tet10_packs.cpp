#include "model/tet10_packs.h"

#include "base/error.h"
#include "model/element_order.h"

namespace ode::soft {
namespace {

// As for linear elements: eight times the work of one, but more nodes at the border.
constexpr std::size_t kLeastSlab = 500;

Eigen::Vector4d gauss_point(int q) {
    Eigen::Vector4d l = Eigen::Vector4d::Constant(kGaussFar);
    l[q] = kGaussNear;
    return l;
}

/// dX/dL at a point.
template <class Nodes>
Mat3 jacobian(const std::vector<Vec3>& rest, const Nodes& node, const Eigen::Vector4d& l) {
    const Gradients10 g = tet10_gradients(l);
    Mat3 j = Mat3::Zero();
    for (std::size_t a = 1; a < 10; ++a)
        j += (rest[static_cast<std::size_t>(node[a])] - rest[static_cast<std::size_t>(node[0])]) *
             g.row(static_cast<Eigen::Index>(a));
    return j;
}

bool is_straight(const TetMesh& mesh, std::size_t e) {
    const auto node = mesh.nodes_of(e);
    const auto at = [&](std::size_t a) -> const Vec3& {
        return mesh.node[static_cast<std::size_t>(node[a])];
    };
    for (std::size_t i = 0; i < 6; ++i) {
        const Vec3& a = at(static_cast<std::size_t>(kTetEdge[i][0]));
        const Vec3& b = at(static_cast<std::size_t>(kTetEdge[i][1]));
        if ((at(4 + i) - 0.5 * (a + b)).norm() > 1e-9 * (b - a).norm())
            return false;
    }
    return true;
}

void check(const TetMesh& mesh, std::size_t e) {
    const auto node = mesh.nodes_of(e);
    double least = INFINITY;
    for (int q = 0; q < 4; ++q)
        for (const Eigen::Vector4d& l : {gauss_point(q), Eigen::Vector4d(Eigen::Vector4d::Unit(q))})
            least = std::min(least, jacobian(mesh.node, node, l).determinant());
    if (!(least > 0))
        throw InputError(format("quadratic element %zu folds over (Jacobian %g m^3): move its "
                                "mid-edge nodes towards the middle of their edges, or swap two "
                                "corners if it is inverted",
                                e, least));
}

template <class Pack>
void set_nodes(Pack& pack, std::size_t lane, std::span<const int> node) {
    for (std::size_t i = 0; i < 10; ++i)
        pack.node[lane][i] = static_cast<unsigned>(node[i]) * NodeArray::kStride;
}

/// @return volume share of the point.
double set_jacobian(double (&b)[9][kPackWidth], std::size_t lane, const Mat3& jacobian) {
    const Mat3 inverse = jacobian.inverse();
    for (int i = 0; i < 9; ++i)
        b[i][lane] = inverse(i / 3, i % 3);
    return jacobian.determinant() / 24;
}

} // namespace

Tet10Packs::Tet10Packs(const TetMesh& mesh, std::span<const Solid> solid)
    : rest_(mesh.node), mass_(mesh.node.size()) {
    if (mesh.order != 2)
        throw InputError(format("quadratic tetrahedra were asked of a mesh of order %d: promote it "
                                "or choose linear ones",
                                mesh.order));
    const std::vector<ElementSlab> slabs = order_elements(mesh, solid.size(), kLeastSlab);
    for (std::size_t slab = 0; slab < slabs.size(); ++slab)
        for (std::size_t s = 0; s < solid.size(); ++s) {
            std::vector<int> straight, curved;
            for (const int e : slabs[slab].of_solid[s]) {
                check(mesh, static_cast<std::size_t>(e));
                (is_straight(mesh, static_cast<std::size_t>(e)) ? straight : curved).push_back(e);
            }
            append(mesh, solid[s], slab, TetShape::quadratic, straight);
            append(mesh, solid[s], slab, TetShape::curved, curved);
        }
    for (const TetBlock& block : block_)
        for (std::size_t e = 0; e < block.elements; ++e) {
            const Element el = element(block, e);
            const Shapes10 share = lumped_volume(el);
            for (int a = 0; a < 10; ++a)
                mass_[static_cast<std::size_t>(el.node[a])] += block.solid.density * share[a];
        }
}

void Tet10Packs::append(const TetMesh& mesh, const Solid& solid, std::size_t slab, TetShape shape,
                        std::span<const int> elements) {
    if (elements.empty())
        return;
    const bool is_curved = shape == TetShape::curved;
    const TetBlock block{slab,
                         solid,
                         shape,
                         is_curved ? curved_.size() : straight_.size(),
                         (elements.size() + kPackWidth - 1) / kPackWidth,
                         elements.size()};
    block_.push_back(block);
    if (is_curved)
        curved_.resize(block.first + block.packs);
    else
        straight_.resize(block.first + block.packs);
    for (std::size_t i = 0; i < block.packs * kPackWidth; ++i) {
        const double counts = i < elements.size() ? 1 : 0;
        const auto node =
            mesh.nodes_of(static_cast<std::size_t>(counts != 0 ? elements[i] : elements.back()));
        const std::size_t pack = block.first + i / kPackWidth, lane = i % kPackWidth;
        if (is_curved) {
            set_nodes(curved_[pack], lane, node);
            for (int q = 0; q < 4; ++q)
                curved_[pack].volume[q][lane] =
                    counts * set_jacobian(curved_[pack].b[q], lane,
                                          jacobian(mesh.node, node, gauss_point(q)));
        } else {
            set_nodes(straight_[pack], lane, node);
            Mat3 edges; // of the corners: free of the mid-edge nodes' rounding
            for (std::size_t j = 0; j < 3; ++j)
                edges.col(static_cast<Eigen::Index>(j)) =
                    mesh.node[static_cast<std::size_t>(node[j + 1])] -
                    mesh.node[static_cast<std::size_t>(node[0])];
            straight_[pack].volume[lane] =
                4 * counts * set_jacobian(straight_[pack].b, lane, edges);
        }
    }
}

const void* Tet10Packs::pack(const TetBlock& block) const noexcept {
    if (block.shape == TetShape::curved)
        return curved_.data() + block.first;
    return straight_.data() + block.first;
}

Tet10Packs::Element Tet10Packs::element(const TetBlock& block, std::size_t e) const noexcept {
    const std::size_t pack = block.first + e / kPackWidth, lane = e % kPackWidth;
    const bool is_curved = block.shape == TetShape::curved;
    const auto& node = is_curved ? curved_[pack].node[lane] : straight_[pack].node[lane];
    Element out;
    for (int i = 0; i < 10; ++i)
        out.node[i] = static_cast<int>(node[i]) / NodeArray::kStride;
    for (int q = 0; q < 4; ++q) {
        const auto& b = is_curved ? curved_[pack].b[q] : straight_[pack].b;
        Mat3 inverse;
        for (int i = 0; i < 9; ++i)
            inverse(i / 3, i % 3) = b[i][lane];
        out.gradient[q] = tet10_gradients(gauss_point(q)) * inverse;
        out.weight[q] =
            is_curved ? curved_[pack].volume[q][lane] : straight_[pack].volume[lane] / 4;
    }
    return out;
}

Eigen::Matrix<double, 10, 10> Tet10Packs::shape_products(const Element& element) const noexcept {
    Eigen::Matrix<double, 10, 10> out = Eigen::Matrix<double, 10, 10>::Zero();
    for (const TetPoint& point : tet_rule_of_degree_5()) {
        const Shapes10 n = tet10_shapes(point.l);
        const double share =
            point.weight * jacobian(rest_, element.node, point.l).determinant() / 6;
        out += share * n * n.transpose();
    }
    return out;
}

Shapes10 Tet10Packs::lumped_volume(const Element& element) const noexcept {
    const Eigen::Matrix<double, 10, 10> products = shape_products(element);
    return products.diagonal() * (products.sum() / products.trace());
}

} // namespace ode::soft
