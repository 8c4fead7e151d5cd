#pragma once

#include "dsp/kernels.h"
#include "dsp/storage.h"
#include "source/body_source.h"
#include "transfer/transfer_table.h"

#include <cstdint>
#include <vector>

namespace ode::sound {

/// What one voice's modes are worth at one ear, as both move: worked out now and then from the
/// table, and on a straight line in between.
class VoiceGains {
public:
    /// Between looks at the table, a millisecond and a third at 96 kHz: a body that turns ten times
    /// a second turns five degrees. One that stands still before an ear costs no look.
    static constexpr int kInterval = 128; ///< [grid samples]

    /// @param lead  columns before the modes.
    explicit VoiceGains(const TransferTable& table, std::size_t lead = 0);

    /// @param ear  world [m].
    /// @return sum over the modes of what differentiates to p R [Pa s m]: with g_v, g_a of the
    ///         table, R (g_v q + g_a q'), R the way from the table's centre.
    double flow(const ModalBlock& block, const Vec3& ear) noexcept;

    /// What looks may cost a listener, shared by its voices: numbers of the table a sample. Some
    /// thirtieth of a core; who is short of it looks more rarely.
    static constexpr double kAllowance = 1500.0;

    /// The same for a run whose leading columns are the click's, of several ears at once: what
    /// differentiates to the pressure.
    /// @param out  of each ear and sample.  @param allowance  for one ear, a sample.
    static void pressure_flow(const ModalRun& run, std::span<VoiceGains* const> gains,
                              std::span<const Vec3> ear, double allowance,
                              float* const* out) noexcept;

private:
    /// Looks at the table when it is time to, and while there is an allowance for it.
    void look_again(const ModalRun& run, const Vec3& ear, double allowance) noexcept;
    // Of a lobe of the finest pattern: nearer places sound alike, and between places so far apart
    // the pattern is as good as straight (0.25^2 / 8 of it).
    static constexpr double kSame = 0.05, kLeap = 0.25;
    static constexpr std::int64_t kLongest = 32 * kInterval;

    /// Gains on their way to those of where the ear will be, if it goes on as since the last look.
    /// @param longest  way [grid samples].
    /// @return whether the table was asked.
    bool look(std::int64_t sample, const TransferTable& table, const Vec3& place,
              std::int64_t longest) noexcept;
    double share(std::int64_t sample) const noexcept; ///< of the way, that is behind
    double lobe(const Vec3& place) const noexcept;    ///< [m]

    std::vector<ModeGain> now_, next_;
    std::size_t lead_;
    AlignedFloats velocity_, acceleration_, velocity_step_, acceleration_step_; ///< kModeLanes
    double lobes_; ///< of the finest pattern, on half a great circle or so
    std::int64_t looked_ = 0;
    std::int64_t watched_ = 0;  ///< after that: whether the ear goes on as it did
    Vec3 seen_ = Vec3::Zero();  ///< the ear in the frame, at the last look [m]
    Vec3 pace_ = Vec3::Zero();  ///< [m] a grid sample
    Vec3 place_ = Vec3::Zero(); ///< of next_ [m]
    bool known_ = false;
    double credit_ = 0.0;
    std::int64_t ramp_ = kInterval; ///< the way to next_ [grid samples]
    bool turns_ = false;            ///< the steps aren't zero
};

} // namespace ode::sound
