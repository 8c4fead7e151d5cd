#pragma once

#include "integrate/node_state.h"
#include "modal/modal_model.h"

#include <span>
#include <vector>

namespace ode::soft {

struct DampedModes {
    const ModalModel& modes; ///< of the body at rest, as it is stepped: order, lumped mass, pins
    std::span<const double> decay; ///< of each mode's amplitude [1/s]
    double rest_decay;             ///< of all deformation that is in no mode [1/s]
    double interval;               ///< at least between two portions [s]
};

/// Damping of a stepped body, mode by mode and without a word to the critical step.
///
/// Now and then the velocity is split, in the frame that turns with the body, into rigid motion,
/// the modes of the body at rest and what is left. Modal velocities are scaled by exp(-2 d dt), the
/// rest by its own rate, rigid motion stays. Each mode then decays by exp(-d t) to rounding,
/// whatever the substep and the interval: a substep of central difference has determinant 1, a
/// portion exp(-2 d dt), and a complex pair of eigenvalues is its root. (The pair is not complex
/// where the interval is within d / w of a multiple of half a period; at 1/(2 f) of the highest
/// mode only modes above all of them can be hit.)
///
/// A portion is a symmetric contraction in the mass product of whatever shape the body has: it
/// takes energy and never gives any, keeps momenta to rounding, and is exact as far as the body is
/// linear. At large strains it damps shapes that are modes no more.
class ModalDamping {
public:
    /// @param mass, inverse_mass  of each node [kg], [1/kg]; 0: held.
    /// @param held   nodes of inverse mass 0; copied, like all else.
    /// @param rest   positions without strain [m]
    /// @param nailed  those held nodes that a moving body carries: deformation is seen from their
    ///                motion, and they get the momentum that damping takes from the rest, so that
    ///                what carries them feels it. Exact for three or more, not in a line.
    ModalDamping(std::span<const double> mass, std::span<const double> inverse_mass,
                 std::span<const int> held, std::span<const Vec3> rest, const DampedModes& damped,
                 std::span<const int> nailed = {});

    /// To be called after each substep of dt [s]; every interval does the work of those since the
    /// last time. Allocates nothing.
    void advance(double dt, NodeState& state) noexcept;

    std::size_t mode_count() const noexcept { return decay_.size(); }

    /// Time not accounted for yet [s]: all there is to remember besides the motion.
    double pending() const noexcept { return pending_; }
    void set_pending(double time) noexcept { pending_ = time; }

private:
    void apply(double dt, NodeState& state) noexcept;
    Mat3 rotation(const NodeArray& position) const noexcept;
    /// Rigid motion of the nailed nodes: their velocity, or one that would give an impulse.
    struct Carrier {
        Vec3 center = Vec3::Zero(), velocity = Vec3::Zero(), spin = Vec3::Zero();
        Vec3 at(const Vec3& x) const noexcept { return velocity + spin.cross(x - center); }
    };
    Carrier carrier(const NodeArray& position, const NodeArray& velocity) const noexcept;
    void give(const Vec3& momentum, const Vec3& angular, const Carrier& to,
              NodeState& state) const noexcept;

    std::vector<double> mass_, inverse_mass_;
    std::vector<int> held_;
    std::vector<int> nailed_;
    std::vector<int>
        frame_; ///< nodes that tell the rotation: the held ones if they can; all if empty
    std::vector<Vec3> rest_;      ///< from the centre of the frame's nodes [m]
    std::size_t rows_;            ///< 3 a node, filled up to whole registers
    AlignedVector<double> shape_; ///< one column a mode, mass-orthonormal [kg^-1/2]
    std::vector<double> decay_;
    double rest_decay_;
    double interval_;
    double pending_ = 0;              ///< time not accounted for yet [s]
    AlignedVector<double> momentum_;  ///< scratch, in the body's frame
    AlignedVector<double> change_;    ///< scratch, in the body's frame
    AlignedVector<double> amplitude_; ///< scratch, one a mode
};

} // namespace ode::soft
