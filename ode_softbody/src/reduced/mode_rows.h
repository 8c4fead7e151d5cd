#pragma once

#include "reduced/modal_basis.h"

#include <span>

namespace ode::soft {

/// q += the node's rows times f: what a push at a node gives the modes.
void project(const ModalBasis& basis, std::size_t node, const Vec3& f,
             std::span<double> q) noexcept;

/// Amplitudes or their rates, made ready to be spread over nodes.
class Spread {
public:
    /// @param scratch  of the basis's columns; in use while this lives.
    Spread(const ModalBasis& basis, std::span<const double> q, std::span<float> scratch) noexcept;

    /// The node's rows times q.
    Vec3 at(std::size_t node) const noexcept {
        Vec3 out;
        expand_(basis_.row(node, 0), basis_.columns, q_, out.data());
        return out;
    }

private:
    const ModalBasis& basis_;
    const float* q_;
    void (*expand_)(const float*, std::size_t, const float*, double*);
};

} // namespace ode::soft
