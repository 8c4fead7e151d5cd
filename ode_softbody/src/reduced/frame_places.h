#pragma once

#include "couple/rough_places.h"
#include "reduced/modal_motion.h"
#include "reduced/mode_rows.h"

#include <array>
#include <optional>

namespace ode::soft {

/// Where a body's frame carries its nodes, and, of those that are asked for, where the modes that
/// are heard move them: what lies above moves nodes by micrometres.
class FramePlaces final : public RoughPlaces {
public:
    /// @param nodes  of the body; borrowed for life, like `motion`.
    FramePlaces(const ModalMotion& motion, NodeState& nodes);

    /// As the motion is now, and must stay while nodes are asked for.
    void begin() noexcept;
    void carry(int node) noexcept override;
    void place(int node) noexcept override;

private:
    const ModalMotion& motion_;
    NodeState& nodes_;
    Mat3 turn_ = Mat3::Identity();
    Vec3 spin_ = Vec3::Zero();
    std::optional<Spread> moved_, rate_;
    std::array<AlignedVector<float>, 2> scratch_;
};

} // namespace ode::soft
