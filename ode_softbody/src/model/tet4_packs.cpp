#include "model/tet4_packs.h"

#include "base/error.h"
#include "model/block_matrix.h"
#include "model/element_order.h"

namespace ode::soft {
namespace {

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
        throw InputError(format("linear tetrahedra were asked of a mesh of order %d", mesh.order));
    const auto order = order_elements(mesh, solid.size());
    for (std::size_t s = 0; s < solid.size(); ++s) {
        const auto& list = order[s];
        if (list.empty())
            continue;
        constexpr std::size_t kWidth = Tet4Pack::kWidth;
        const Block block{solid[s], pack_.size(), (list.size() + kWidth - 1) / kWidth, list.size()};
        pack_.resize(pack_.size() + block.packs);
        for (std::size_t i = 0; i < block.packs * kWidth; ++i) {
            const bool counts = i < list.size();
            fill(pack_[block.first + i / kWidth], static_cast<int>(i % kWidth), mesh,
                 static_cast<std::size_t>(counts ? list[i] : list.back()), counts);
        }
        block_.push_back(block);
        for (std::size_t e = 0; e < block.elements; ++e) {
            const Element element = this->element(block, e);
            for (const int node : element.node)
                mass_[static_cast<std::size_t>(node)] += block.solid.density * element.volume / 4;
        }
    }
}

Tet4Packs::Element Tet4Packs::element(const Block& block, std::size_t e) const noexcept {
    const Tet4Pack& p = pack_[block.first + e / Tet4Pack::kWidth];
    const std::size_t lane = e % Tet4Pack::kWidth;
    Element out;
    for (int i = 0; i < 9; ++i)
        out.gradient(1 + i / 3, i % 3) = p.b[i][lane];
    out.gradient.row(0) = -out.gradient.bottomRows<3>().colwise().sum();
    for (int i = 0; i < 4; ++i)
        out.node[i] = static_cast<int>(p.node[lane][i]) / NodeArray::kStride;
    out.volume = p.volume[lane];
    return out;
}

std::vector<int> Tet4Packs::connectivity() const {
    std::vector<int> out;
    for (const Block& block : block_)
        for (std::size_t e = 0; e < block.elements; ++e) {
            const Element el = element(block, e);
            out.insert(out.end(), std::begin(el.node), std::end(el.node));
        }
    return out;
}

Eigen::SparseMatrix<double> Tet4Packs::consistent_mass() const {
    BlockMatrix m(connectivity(), 4, node_count());
    for (const Block& block : block_)
        for (std::size_t e = 0; e < block.elements; ++e) {
            const Element el = element(block, e);
            const double share = block.solid.density * el.volume / 20;
            for (int a = 0; a < 4; ++a)
                for (int b = 0; b < 4; ++b)
                    m.add(el.node[a], el.node[b], (a == b ? 2 : 1) * share * Mat3::Identity());
        }
    return m.take();
}

Mat3 deformation_gradient(const Tet4Packs::Element& element, const NodeArray& position) noexcept {
    Mat3 f = Mat3::Zero();
    for (int a = 1; a < 4; ++a) // differences first: see StvkLinear on rounding
        f += (position[static_cast<std::size_t>(element.node[a])] -
              position[static_cast<std::size_t>(element.node[0])]) *
             element.gradient.row(a);
    return f;
}

} // namespace ode::soft
