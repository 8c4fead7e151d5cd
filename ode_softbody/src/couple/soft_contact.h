#pragma once

#include "couple/pair_contact.h"
#include "couple/surface_contact.h"

#include <optional>

namespace ode::soft {

/// Contact of two soft bodies, of each one's points with the other's triangles, or of one body with
/// itself. Kept from step to step as long as the pair stays near, because friction has a memory.
///
/// Between looks through the trees nothing is sought: a look lasts until the surfaces, at kHaste
/// times today's speed, may have come within reach.
class SoftContact final : public PairContact {
public:
    /// Surfaces are borrowed for the contact's life. One surface twice: self contact.
    SoftContact(SoftSurface& a, SoftSurface& b);

    bool is_self() const noexcept { return &a_ == &b_; }

    void begin_step(const SoftPartner& a, const SoftPartner& b) noexcept override;
    void keep() override;
    void take_back() noexcept override;

    SoftContactTally add_force(const SoftSide& a, const SoftSide& b, double dt,
                               unsigned long when) override;

private:
    void look(const SoftSide& a, const SoftSide& b, double dt, unsigned long when,
              SoftContactTally& tally);
    void look_away(double nearest) noexcept;
    void schedule(double budget) noexcept; ///< [m] that the surfaces may move before a look
    bool is_near() const noexcept {
        return points_of_a_.is_near() || (points_of_b_ && points_of_b_->is_near());
    }

    SoftSurface& a_;
    SoftSurface& b_;
    SurfaceContact points_of_a_;
    std::optional<SurfaceContact> points_of_b_; ///< none for self contact
    double fastest_ = 0;                        ///< that the surfaces move on each other [m/s]
    double rate_ = 0;                           ///< the same, with room till the next look [m/s]
    double way_ = 0;                            ///< since the last look, at most [m]
    double last_dt_ = 0, kept_dt_ = 0;          ///< of the last substep [s]
    double look_again_in_ = 0;                  ///< [s]
};

} // namespace ode::soft
