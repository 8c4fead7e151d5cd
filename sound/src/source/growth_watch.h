#pragma once

namespace ode::sound {

class FlowHistory;

/// Tells motion that no stable step makes from motion that is only loud.
///
/// Free vibration under a linear method of two steps obeys u'' + u = 2 cos(theta) u' for the flows
/// u, u', u'' of three intervals, mode by mode. So do their third differences a, in which what
/// varies slowly counts for little ((w h)^6 of its energy), and the quotient
///
///     r = -(a_0 + a_2) . a_1 / (a_1 . a_1)
///
/// lies between the least and the largest of -2 cos(theta): within -2 .. 2 while every mode is
/// stable. A mode beyond the critical step alternates and grows, and takes r above 2; where an
/// interval holds an even number of substeps it only grows, and takes r below -2, as pushes may do
/// for a moment. What growth without alternation there is (explicit Euler's, at any step) cannot be
/// told from a bow's by listening: that is left to the body's own books of energy.
class GrowthWatch {
public:
    /// Between looks [s]; bodies of longer substeps are looked at in every interval.
    static constexpr double kPitch = 1.5e-4;

    /// After an interval has been added.
    /// @param like  it was made like the one before: by the same area vectors, or both by new ones,
    ///              and the motion has no break between them.
    /// @return whether flow grew as nothing stable does.
    bool look(FlowHistory& history, bool like) noexcept;

    /// @param square  of a that is nothing but rounding errors [m^6].
    void set_floor(double square) noexcept { floor_ = square; }
    static constexpr double kGain = 70.0; ///< sum of (1 -4 6 -4 1)^2: what places' errors count

private:
    static constexpr int kRows = 8; ///< three quotients in a row

    int known_ = 0; ///< alike
    double since_ = 0.0;
    double floor_ = 0.0;
};

} // namespace ode::sound
