#pragma once

#include "collide/aabb.h"
#include "couple/surface_nodes.h"
#include "reduced/contact_view.h"
#include "reduced/frame_places.h"

#include <memory>
#include <span>
#include <vector>

namespace ode::soft {

/// A body while it moves in its modes: what contact, observers and ODE see of it. Nodes are brought
/// up to date only where and when somebody asks for them.
class ModalTier {
public:
    /// @param nodes    of the body; borrowed for life, written by place() and refresh()
    /// @param surface  borrowed for life
    ModalTier(std::shared_ptr<const ModalBasis> basis, const SurfaceNodes& surface,
              std::span<const Vec3> normal, NodeState& nodes);

    ModalMotion& motion() noexcept { return motion_; }
    const ModalMotion& motion() const noexcept { return motion_; }

    bool stale() const noexcept { return stale_; } ///< nodes are older than the motion
    void refresh() noexcept;                       ///< all of them, with all momentum
    void place_all() noexcept; ///< as observers see them: without the last digits of momentum
    void place_surface() noexcept;
    /// To see what is near; good until the motion goes on. @param heard  see FramePlaces
    RoughPlaces& rough_places(bool heard = false) noexcept {
        rough_.begin(heard);
        return rough_;
    }
    /// Those that contact looks at, before a substep of dt [s], unless they are up to date.
    void place_near(double dt) noexcept;
    JointInertia& joint() noexcept { return view_; } ///< good after place_near()
    /// @param pushed  by contact.
    void moved(bool pushed) noexcept {
        stale_ = near_stale_ = true;
        pushed_ = pushed;
        view_.end(pushed);
    }
    bool was_pushed() const noexcept { return pushed_; } ///< in the last substep

    void clear_near() noexcept {
        near_.clear();
        near_stale_ = true;
    }
    std::vector<int>& near() noexcept { return near_; } ///< to add to; then settle_near()
    void settle_near();

    std::span<const double> inverse_mass() const noexcept { return inverse_mass_; }

    /// No longer substep is wanted [s].
    double pace() const noexcept { return pace_; }
    void set_pace(double dt) noexcept { pace_ = dt; }

    void keep() noexcept { motion_.keep(); }
    void take_back() noexcept {
        motion_.take_back();
        moved(true);
    }

    /// Of all nodes, by the rest shape and the largest displacement.
    Aabb box() const noexcept;

private:
    ModalMotion motion_;
    ContactView view_;
    NodeGroups groups_;
    FramePlaces rough_;
    const SurfaceNodes& surface_;
    NodeState& nodes_;
    std::vector<int> near_;
    std::vector<int> all_;
    std::vector<double> inverse_mass_;
    Aabb rest_box_;
    double pace_ = 0;
    bool stale_ = false;
    bool near_stale_ = true;
    bool pushed_ = false;
};

} // namespace ode::soft
