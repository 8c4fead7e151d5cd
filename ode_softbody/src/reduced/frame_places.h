#pragma once

#include "couple/rough_places.h"
#include "reduced/modal_motion.h"
#include "reduced/mode_rows.h"

#include <array>
#include <optional>
#include <vector>

namespace ode::soft {

/// Where a body's frame carries its nodes, and, of those that are asked for, where the modes move
/// them.
class FramePlaces final : public RoughPlaces {
public:
    /// @param nodes  of the body; borrowed for life, like `motion` and `groups`.
    FramePlaces(const ModalMotion& motion, const NodeGroups& groups, NodeState& nodes);

    /// As the motion is now, and must stay while nodes are asked for.
    /// @param heard  nodes are placed by the modes that are heard alone, else by all.
    void begin(bool heard) noexcept;
    void carry(int node) noexcept override;
    void place(int node) noexcept override;
    Swing swing(int node, const Vec3& direction) noexcept override;

private:
    const ModalMotion& motion_;
    NodeState& nodes_;
    std::vector<unsigned long> placed_; ///< in which look each node was
    unsigned long look_ = 0;
    std::optional<Spread> moved_, rate_;
    std::array<AlignedVector<float>, 4> scratch_; ///< the last two: of each mode's swing()
};

} // namespace ode::soft
