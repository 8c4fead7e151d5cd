#pragma once

#include "couple/pair_contact.h"
#include "couple/soft_volume.h"

#include <vector>

namespace ode::soft {

/// The volume penalty of P01 3.1: each two tetrahedra that overlap push each other apart with the
/// potential kappa V^2 / 2 of their common volume V. Its force, kappa V dV/dx, is proportional to
/// the volume and along the area-weighted normal, as P01 has it; P01 lets it act at the centroid,
/// here each corner gets its own derivative, or there would be no potential.
///
/// In a substep V is a coordinate like any depth, along a direction that is fixed for the substep:
/// the discrete gradient (conserving_press) keeps energy as far as V is linear in it, and a book of
/// the energy that each pair has taken (as SurfaceContact's) forbids to give back more. Pairs share
/// nodes and agree in two sweeps.
///
/// Both momenta are kept to rounding: V does not change when all corners move as one. Friction acts
/// on both sides at the centroid.
///
/// Known limits. Force comes from V^2, so that a corner that begins to enter meets almost nothing
/// and then a wall; a tetrahedron wholly inside another feels nothing from it; bodies thinner than
/// a substep's way pass each other. Quadratic elements are taken by their corners.
class VolumeContact final : public PairContact {
public:
    /// Borrowed for the contact's life. One volume twice: self contact.
    VolumeContact(SoftVolume& a, SoftVolume& b);

    void begin_step(const SoftPartner& a, const SoftPartner& b) noexcept override;
    void keep() override {
        kept_near_ = near_;
        kept_touch_ = touch_;
        kept_dt_ = last_dt_;
    }
    void take_back() noexcept override {
        near_.swap(kept_near_);
        touch_.swap(kept_touch_);
        last_dt_ = kept_dt_;
    }
    SoftContactTally add_force(const SoftSide& a, const SoftSide& b, double dt,
                               unsigned long when) override;

private:
    struct Near { ///< two tetrahedra that may overlap before the next look
        int first;
        int second;
        Overlap overlap{};           ///< hidden when they were put into each other [m^3]
        Vec3 stretch = Vec3::Zero(); ///< of the friction spring, world [m]
        double stiffness = 0;        ///< kappa, never rises while it bears [N/m^5]
        double paid = 0;             ///< energy taken and not given back [J]
        double wake = 0;             ///< way until which they can't overlap [m]
        bool bears = false;
        bool before(const Near& o) const noexcept {
            return first != o.first ? first < o.first : second < o.second;
        }
    };
    struct Touch {
        std::size_t near;
        TetOverlap shape;
        double volume;     ///< that the force sees [m^3]
        double rate;       ///< of the volume, half a substep ago [m^3/s]
        double compliance; ///< sum of |gradient|^2 / mass [m^4/kg]
        double damping;    ///< [N s/m^5]
        double press;      ///< so far [N/m^2]
        double spring;     ///< its conserving part
    };

    bool is_self() const noexcept { return &a_ == &b_; }
    void look(const SoftSide& a, const SoftSide& b, double dt, unsigned long when,
              SoftContactTally& tally);
    void keep_memory();
    void schedule(double budget) noexcept;
    void settle(const SoftSide& a, const SoftSide& b) noexcept;
    void find_touching(const SoftSide& a, const SoftSide& b, double dt, SoftContactTally& tally);
    void sweep(const SoftSide& a, const SoftSide& b, double dt) noexcept;
    std::size_t drag(const SoftSide& a, const SoftSide& b, double dt) noexcept;

    /// Sum over both sides' corners: visit(side, node, gradient).
    template <class Visit>
    void each_corner(const Touch& touch, const SoftSide& a, const SoftSide& b,
                     Visit visit) const noexcept;

    SoftVolume& a_;
    SoftVolume& b_;
    PairLaw law_;
    double softest_ = 0;         ///< what the weaker side bears, spring [1/s^2]
    double softest_damping_ = 0; ///< dashpot [1/s]
    double kappa_ = 0;           ///< [N/m^5]
    double fastest_ = 0;         ///< that they move on each other [m/s]
    double rate_ = 0;            ///< the same, with room till the next look [m/s]
    double way_ = 0;             ///< since the last look, at most [m]
    double last_dt_ = 0, kept_dt_ = 0;
    double look_again_in_ = 0; ///< [s]
    std::vector<Near> near_;   ///< ascending
    std::vector<Near> kept_near_;
    std::vector<Near> fresh_; ///< scratch of look()
    std::vector<Touch> touch_, kept_touch_;
};

} // namespace ode::soft
