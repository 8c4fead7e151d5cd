#pragma once

#include "base/tasks.h"
#include "model/block_matrix.h"
#include "model/element_frequency.h"
#include "model/element_order.h"
#include "model/strain_extremes.h"
#include "model/tet_model.h"
#include "model/viscous_tangent.h"

#include <array>

namespace ode::soft {

template <class Law, class Packs>
TetModel<Law, Packs>::TetModel(const TetMesh& mesh, std::span<const Solid> solid, Isa isa)
    : packs_(mesh, solid) {
    for (const TetBlock& block : packs_.blocks()) {
        if (block.slab == slab_begin_.size())
            slab_begin_.push_back(part_.size());
        part_.push_back(
            {Law::kernel(isa, block.shape, block.solid.is_viscous()), Law::constants(block.solid)});
    }
    slab_begin_.push_back(part_.size());
}

template <class Law, class Packs>
DeformationRange TetModel<Law, Packs>::add_slab(std::size_t slab, const NodeArray& position,
                                                const NodeArray& velocity,
                                                NodeArray& force) const noexcept {
    DeformationRange range = kNoDeformation;
    for (std::size_t i = slab_begin_[slab]; i < slab_begin_[slab + 1]; ++i) {
        const TetBlock& block = packs_.blocks()[i];
        part_[i].add(packs_.pack(block), block.packs, part_[i].constants, position.data(),
                     velocity.data(), force.data(), range);
    }
    return range;
}

template <class Law, class Packs>
StrainExtremes TetModel<Law, Packs>::add_force(const NodeArray& position, const NodeArray& velocity,
                                               NodeArray& force) const noexcept {
    const std::size_t slabs = slab_begin_.size() - 1;
    if (slabs == 1)
        return strain_extremes(add_slab(0, position, velocity, force));
    std::array<DeformationRange, kMostSlabs> range;
    for (std::size_t parity = 0; parity < 2; ++parity)
        in_pieces(slabs / 2, [&](std::size_t i) {
            const std::size_t slab = 2 * i + parity;
            range[slab] = add_slab(slab, position, velocity, force);
        });
    for (std::size_t slab = 1; slab < slabs; ++slab)
        range[0] = widened(range[0], range[slab]);
    return strain_extremes(range[0]);
}

template <class Law, class Packs>
double TetModel<Law, Packs>::energy(const NodeArray& position) const noexcept {
    double sum = 0;
    for (const TetBlock& block : packs_.blocks())
        for (std::size_t e = 0; e < block.elements; ++e) {
            const auto element = packs_.element(block, e);
            for (int q = 0; q < element.kPoints; ++q)
                sum += element.weight[q] *
                       Law::energy(block.solid, deformation_gradient(element, q, position));
        }
    return sum;
}

template <class Law, class Packs>
std::vector<int> TetModel<Law, Packs>::connectivity() const {
    std::vector<int> out;
    for (const TetBlock& block : packs_.blocks())
        for (std::size_t e = 0; e < block.elements; ++e) {
            const auto element = packs_.element(block, e);
            out.insert(out.end(), std::begin(element.node), std::end(element.node));
        }
    return out;
}

template <class Law, class Packs>
BlockMatrix TetModel<Law, Packs>::tangent_pattern() const {
    return BlockMatrix(connectivity(), Packs::Element::kNodes, node_count());
}

template <class Law, class Packs>
void TetModel<Law, Packs>::add_tangent(const NodeArray& position, double elastic, double viscous,
                                       BlockMatrix& out) const noexcept {
    for (const TetBlock& block : packs_.blocks()) {
        const bool has_viscous = viscous != 0 && block.solid.is_viscous();
        for (std::size_t e = 0; e < block.elements; ++e) {
            const auto element = packs_.element(block, e);
            for (int q = 0; q < element.kPoints; ++q) {
                const Mat3 f = deformation_gradient(element, q, position);
                const typename Law::Tangent tangent(block.solid, f);
                const ViscousTangent damping(block.solid, f);
                const auto& g = element.gradient[q];
                for (int a = 0; a < element.kNodes; ++a)
                    for (int b = 0; b < element.kNodes; ++b) {
                        Mat3 sum = elastic * tangent.block(g.row(a), g.row(b));
                        if (has_viscous)
                            sum += viscous * damping.block(g.row(a), g.row(b));
                        out.add(element.node[a], element.node[b], element.weight[q] * sum);
                    }
            }
        }
    }
}

template <class Law, class Packs>
Eigen::SparseMatrix<double> TetModel<Law, Packs>::consistent_mass() const {
    BlockMatrix m = tangent_pattern();
    for (const TetBlock& block : packs_.blocks())
        for (std::size_t e = 0; e < block.elements; ++e) {
            const auto element = packs_.element(block, e);
            const auto products = packs_.shape_products(element);
            for (int a = 0; a < element.kNodes; ++a)
                for (int b = 0; b < element.kNodes; ++b)
                    m.add(element.node[a], element.node[b],
                          block.solid.density * products(a, b) * Mat3::Identity());
        }
    return m.take();
}

template <class Law, class Packs>
double TetModel<Law, Packs>::max_frequency_bound() const {
    constexpr int kSize = 3 * Packs::Element::kNodes;
    ElementFrequency bound;
    for (const TetBlock& block : packs_.blocks()) {
        const typename Law::Tangent tangent(block.solid, Mat3::Identity());
        for (std::size_t e = 0; e < block.elements; ++e) {
            const auto element = packs_.element(block, e);
            const auto share = packs_.lumped_volume(element);
            Eigen::MatrixXd k = Eigen::MatrixXd::Zero(kSize, kSize);
            for (int q = 0; q < element.kPoints; ++q)
                for (int a = 0; a < element.kNodes; ++a)
                    for (int b = 0; b < element.kNodes; ++b)
                        k.template block<3, 3>(3 * a, 3 * b) +=
                            element.weight[q] / std::sqrt(share[a] * share[b]) *
                            tangent.block(element.gradient[q].row(a), element.gradient[q].row(b));
            bound.include(k / block.solid.density);
        }
    }
    return bound.value();
}

} // namespace ode::soft
