#include "model/tet4_packs.h"

#include "base/error.h"
#include "model/element_order.h"

namespace ode::soft {
namespace {

// Two threads gain nothing on smaller bodies: what nodes at their border cost, a fifth of a
// microsecond a cache line from core to core, is what half of the elements take.
constexpr std::size_t kLeastSlab = 600;

void fill(Tet4Pack& pack, int lane, const TetMesh& mesh, std::size_t e, bool counts) {
    const auto node = mesh.nodes_of(e);
    Mat3 edges;
    for (std::size_t i = 0; i < 3; ++i)
        edges.col(static_cast<Eigen::Index>(i)) = mesh.node[static_cast<std::size_t>(node[i + 1])] -
                                                  mesh.node[static_cast<std::size_t>(node[0])];
    const double volume = edges.determinant() / 6;
    if (!(volume > 0))
        throw InputError(format("element %zu has the volume %g m^3; it must be positive: swap two "
                                "of its nodes or remove it",
                                e, volume));
    const Mat3 inverse = edges.inverse();
    for (int i = 0; i < 9; ++i)
        pack.b[i][lane] = inverse(i / 3, i % 3);
    pack.volume[lane] = counts ? volume : 0;
    for (std::size_t i = 0; i < 4; ++i)
        pack.node[lane][i] = static_cast<unsigned>(node[i]) * NodeArray::kStride;
}

} // namespace

Tet4Packs::Tet4Packs(const TetMesh& mesh, std::span<const Solid> solid) : mass_(mesh.node.size()) {
    if (mesh.order != 1)
        throw InputError(format("linear tetrahedra were asked of a mesh of order %d: give the "
                                "linear mesh or choose quadratic ones",
                                mesh.order));
    const std::vector<ElementSlab> slabs = order_elements(mesh, solid.size(), kLeastSlab);
    for (std::size_t slab = 0; slab < slabs.size(); ++slab)
        for (std::size_t s = 0; s < solid.size(); ++s)
            append(mesh, solid[s], slab, slabs[slab].of_solid[s]);
}

void Tet4Packs::append(const TetMesh& mesh, const Solid& solid, std::size_t slab,
                       std::span<const int> elements) {
    if (elements.empty())
        return;
    const TetBlock block{slab,
                         solid,
                         TetShape::linear,
                         pack_.size(),
                         (elements.size() + kPackWidth - 1) / kPackWidth,
                         elements.size()};
    pack_.resize(pack_.size() + block.packs);
    for (std::size_t i = 0; i < block.packs * kPackWidth; ++i) {
        const bool counts = i < elements.size();
        fill(pack_[block.first + i / kPackWidth], static_cast<int>(i % kPackWidth), mesh,
             static_cast<std::size_t>(counts ? elements[i] : elements.back()), counts);
    }
    block_.push_back(block);
    for (std::size_t e = 0; e < block.elements; ++e) {
        const Element el = element(block, e);
        for (const int node : el.node)
            mass_[static_cast<std::size_t>(node)] += block.solid.density * el.weight[0] / 4;
    }
}

Tet4Packs::Element Tet4Packs::element(const TetBlock& block, std::size_t e) const noexcept {
    const Tet4Pack& p = pack_[block.first + e / kPackWidth];
    const std::size_t lane = e % kPackWidth;
    Element out;
    auto& gradient = out.gradient[0];
    for (int i = 0; i < 9; ++i)
        gradient(1 + i / 3, i % 3) = p.b[i][lane];
    gradient.row(0) = -gradient.bottomRows<3>().colwise().sum();
    for (int i = 0; i < 4; ++i)
        out.node[i] = static_cast<int>(p.node[lane][i]) / NodeArray::kStride;
    out.weight[0] = p.volume[lane];
    return out;
}

Eigen::Vector4d Tet4Packs::lumped_volume(const Element& element) const noexcept {
    return Eigen::Vector4d::Constant(element.weight[0] / 4);
}

Eigen::Matrix4d Tet4Packs::shape_products(const Element& element) const noexcept {
    return element.weight[0] / 20 * (Eigen::Matrix4d::Ones() + Eigen::Matrix4d::Identity());
}

} // namespace ode::soft
