#pragma once

#include "source/rigid_sound.h"

namespace ode::sound {

/// The velocity of a body as a whole, on the samples of the grid: means from sample to sample, of
/// what is known from time to time, filtered as RigidSound asks. Straight lines between the times;
/// means, because a blow is shorter than a sample.
class RigidWay {
public:
    using Six = RigidSound::Six;

    /// @param time  T of RigidSound [s].  @param rate  of the grid [Hz].
    RigidWay(double time, double rate) noexcept;

    void start(double time, const Six& velocity) noexcept;
    /// What is known next. step_to() asks for times up to it.
    void go_on(double time, const Six& velocity) noexcept;
    void step_to(double time) noexcept; ///< the next sample's
    /// Takes the sample's mean. @param share  of it that is heard.
    void listen(double share) noexcept;

    const Six& velocity() const noexcept { return velocity_; } ///< V [m/s], [rad/s]
    const Six& slope() const noexcept { return slope_; }       ///< V' [m/s^2], [rad/s^2]

private:
    Six way_at(double time) const noexcept; ///< since begin_

    double lapse_;               ///< of a sample [s]
    double keep_, pass_;         ///< of the filter's step
    double begin_ = 0, end_ = 0; ///< of the interval that is known [s]
    double stepped_ = 0;         ///< time of the last sample, or of the beginning [s]
    Six velocity_begin_ = Six::Zero(), velocity_end_ = Six::Zero();
    Six pending_ = Six::Zero(); ///< way since the last sample, up to begin_
    Six mean_ = Six::Zero();
    Six heard_ = Six::Zero(); ///< U at the last sample
    Six velocity_ = Six::Zero();
    Six slope_ = Six::Zero();
};

} // namespace ode::sound
