#include "world/modal_tier.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace ode::soft {

ModalTier::ModalTier(std::shared_ptr<const ModalBasis> basis, const SurfaceNodes& surface,
                     std::span<const Vec3> normal, NodeState& nodes)
    : motion_(std::move(basis)), view_(motion_, nodes), groups_(surface.node, motion_.basis().rest),
      rough_(motion_, groups_, nodes), surface_(surface), nodes_(nodes),
      inverse_mass_(motion_.basis().nodes(), 0.0), rest_box_(Aabb::empty()) {
    for (std::size_t i = 0; i < surface.node.size(); ++i) {
        const auto n = static_cast<std::size_t>(surface.node[i]);
        inverse_mass_[n] = motion_.inverse_mass(n, normal[i]);
        rest_box_.include(motion_.basis().rest[n]);
    }
    near_.reserve(surface.node.size());
    all_.resize(motion_.basis().nodes());
    std::iota(all_.begin(), all_.end(), 0);
}

void ModalTier::refresh() noexcept {
    motion_.give(nodes_);
    stale_ = false;
}

void ModalTier::place_all() noexcept { motion_.place(all_, nodes_); }

void ModalTier::place_surface() noexcept { motion_.place(surface_.node, nodes_); }

void ModalTier::place_near(double dt) noexcept {
    if (near_stale_)
        view_.begin(near_, dt);
    near_stale_ = false;
}

void ModalTier::settle_near() {
    std::sort(near_.begin(), near_.end());
    near_.erase(std::unique(near_.begin(), near_.end()), near_.end());
}

Aabb ModalTier::box() const noexcept {
    const ModalState& state = motion_.state();
    const Mat3 turn = state.turn.toRotationMatrix();
    const Vec3 middle = (rest_box_.low + rest_box_.high) / 2;
    const Vec3 half = (rest_box_.high - rest_box_.low) / 2;
    const Vec3 reach = turn.cwiseAbs() * half;
    Aabb box{state.center + turn * middle - reach, state.center + turn * middle + reach};
    box.grow(motion_.largest_displacement());
    return box;
}

} // namespace ode::soft
