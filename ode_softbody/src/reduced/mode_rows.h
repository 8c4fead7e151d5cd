#pragma once

#include "couple/joint_inertia.h"
#include "reduced/modal_basis.h"

#include <array>
#include <span>

namespace ode::soft {

/// q += the node's rows times f: what a push at a node gives the modes.
/// @param q  of the first modes; so below.
void project(const ModalBasis& basis, std::size_t node, const Vec3& f,
             std::span<double> q) noexcept;

/// The same of rows of any stride, whole lanes, all of whose columns q has.
void project(const float* row, std::size_t stride, const Vec3& f, std::span<double> q) noexcept;

/// The same in single precision, mode by mode times `scale`.
void project(const ModalBasis& basis, std::size_t node, const Vec3& f, std::span<const float> scale,
             std::span<float> q) noexcept;

/// Sum over the modes of scale times the square of the weighted nodes' rows times f.
double square(const ModalBasis& basis, const CarriedPoint& point, const Vec3& f,
              std::span<const float> scale) noexcept;

/// Sum over the modes of scale times the products of a node's rows: xx, yy, zz, xy, xz, yz.
std::array<double, 6> squares(const ModalBasis& basis, std::size_t node,
                              std::span<const float> scale) noexcept;

/// Sums over the modes of q, and of r, times the size of the node's rows times f.
std::array<double, 2> reaches(const ModalBasis& basis, std::size_t node, const Vec3& f,
                              std::span<const float> q, std::span<const float> r) noexcept;

/// Amplitudes or their rates, made ready to be spread over nodes.
class Spread {
public:
    /// @param q        of the first modes, whole lanes.
    /// @param scratch  as long at least; in use while this lives.
    Spread(const ModalBasis& basis, std::span<const double> q, std::span<float> scratch) noexcept;
    /// @param q  borrowed for life.
    Spread(const ModalBasis& basis, std::span<const float> q) noexcept
        : Spread(basis.shape.data(), basis.columns, q) {}
    /// @param shape  rows of `stride` columns, whole lanes, as ModalBasis::shape; borrowed for
    /// life.
    Spread(const float* shape, std::size_t stride, std::span<const float> q) noexcept;

    /// The node's rows times q.
    Vec3 at(std::size_t node) const noexcept {
        Vec3 out;
        expand_(shape_ + 3 * node * stride_, stride_, columns_, q_, out.data());
        return out;
    }

    /// The same of this and another of as many modes: rows are fetched once.
    void at(std::size_t node, const Spread& other, Vec3& own, Vec3& others) const noexcept {
        expand_pair_(shape_ + 3 * node * stride_, stride_, columns_, q_, other.q_, own.data(),
                     others.data());
    }

private:
    const float* shape_;
    std::size_t stride_;
    const float* q_;
    std::size_t columns_; ///< that q has
    void (*expand_)(const float*, std::size_t, std::size_t, const float*, double*);
    void (*expand_pair_)(const float*, std::size_t, std::size_t, const float*, const float*,
                         double*, double*);
};

} // namespace ode::soft
