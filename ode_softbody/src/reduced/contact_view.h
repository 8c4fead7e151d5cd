#pragma once

#include "couple/joint_inertia.h"
#include "reduced/modal_motion.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace ode::soft {

/// A body in its modes, as contact sees it through a substep: some nodes' places, their mean
/// velocities over the substep past (what leapfrog's velocity is) and, foreseen, over the one to
/// come, which every push changes at all nodes at once.
class ContactView final : public JointInertia {
public:
    /// @param nodes  of the body; borrowed for life, like `motion`.
    ContactView(ModalMotion& motion, NodeState& nodes);

    /// Begins a substep: writes places [m] and velocities [m/s] of `near` nodes.
    void begin(std::span<const int> near, double dt) noexcept;
    /// The motion has advanced. @param pushed  by anybody, whether this view was told or not.
    void end(bool pushed) noexcept {
        ++substep_;
        pushed_ |= pushed;
    }

    Vec3 ahead(const CarriedPoint& point) const noexcept override;
    double compliance(const CarriedPoint& point, const Vec3& direction) const noexcept override;
    Vec3 yield(std::size_t node, const Vec3& direction) const noexcept override;
    void push(std::size_t node, const Vec3& force) noexcept override;

private:
    /// What modes do within substeps of one length; few lengths are in use at a time.
    struct Length {
        double dt = 0; ///< [s]
        std::size_t band = 0;
        unsigned long used = 0;    ///< substep in which it was last
        AlignedVector<float> rate; ///< mean over the substep for 1 N, mode by mode
        /// squares() of a node by these, where asked for since they were worked out.
        std::vector<std::array<double, 6>> yield;
        std::vector<std::uint8_t> known;
    };
    void choose_length(double dt) noexcept;

    std::span<const float> rates() const noexcept {
        return std::span(length_->rate).first(length_->band);
    }

    ModalMotion& motion_;
    NodeState& nodes_;
    double dt_ = 0;                     ///< of this substep [s]
    unsigned long substep_ = 1;         ///< since the beginning
    std::vector<unsigned long> placed_; ///< substep in which each node was last
    NodeArray at_;                      ///< there [m]
    NodeArray free_;                    ///< after the substep, if nothing pushes [m]
    bool pushed_ = false;               ///< in this substep, or, before begin(), in the last
    Mat3 turn_ = Mat3::Identity();
    Vec3 impulse_ = Vec3::Zero(), turning_ = Vec3::Zero(); ///< of all pushes, per second [N], [N m]
    Vec3 rigid_gain_ = Vec3::Zero(), spin_gain_ = Vec3::Zero(); ///< by them [m/s], [rad/s]
    std::array<Length, 4> lengths_;
    Length* length_ = nullptr;
    Mat3 lightness_ = Mat3::Zero(); ///< inverse inertia, world [1/(kg m^2)]
    AlignedVector<float> gain_;     ///< mean rates that pushes have given
    std::array<AlignedVector<float>, 3> scratch_;
};

} // namespace ode::soft
