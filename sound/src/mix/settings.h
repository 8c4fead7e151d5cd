#pragma once

#include "source/radiation.h"

#include <cstdint>
#include <string_view>

namespace ode::sound {

/// How waves are sampled; see dSoundSetSampling().
enum class Sampling { kSinc, kPaper };

/// Name by name, in the order of the enumeration; empty past the last.
std::string_view sampling_name(int i) noexcept;
/// @return false for an unknown name.
bool find_sampling(std::string_view name, Sampling& sampling) noexcept;

/// What all listeners of a world share.
struct Settings {
    int rate = 48000; ///< audio frames per second [Hz]
    Radiation radiation = Radiation::kMonopole;
    Sampling sampling = Sampling::kSinc;
    Air air;
    double full_scale = 20.0; ///< [Pa] that becomes 1.0

    /// Samples that sources are sent at [Hz].
    double send_rate() const noexcept;

    /// Least BodySource::lag().
    int lag() const noexcept;
    /// First frame that waves from sources after `time` [s] could still reach: frames before it may
    /// be read. This bounds latency: 2.1 ms at 48 kHz for "sinc", 0.25 ms for "paper".
    /// @param lag  of sources; more where a body has substeps beyond 167 us (at 48 kHz).
    std::int64_t first_open_frame(double time, int lag) const noexcept;
    std::int64_t first_open_frame(double time) const noexcept {
        return first_open_frame(time, lag());
    }
};

} // namespace ode::sound
