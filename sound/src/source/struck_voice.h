#pragma once

#include "dsp/kernels.h"
#include "dsp/storage.h"
#include "source/kicks.h"
#include "source/modal_voice.h"
#include "strike/sampled_pulse.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <memory>

namespace ode::sound {

/// Where the frame of a rigid body is.
struct FramePose {
    double time = 0.0;          ///< [s]
    Vec3 center = Vec3::Zero(); ///< [m]
    Eigen::Quaterniond turn{1.0, 0.0, 0.0, 0.0};
};

/// What rigid bodies of one shape and material share of their sound.
struct StruckVoiceModel : ModalVoiceModel {
    /// What the recurrence adds to q and q' a sample, four rows of `columns` (see Kernels::ring):
    /// the click's columns, the modes', and silent ones up to kModeLanes.
    AlignedFloats step;
    std::size_t columns = 0;
    ClickColumns click;
    std::vector<double> damped; ///< of each mode: sqrt(omega^2 - decay^2) [rad/s]
    /// What q' of each mode must be to be heard: 20 dB below hearing at 1 m.
    std::vector<double> least_rate;
    std::vector<float> sharpen; ///< 1 / SampledPulse::smoothing(); 0 where the rate can't carry it
    /// Scratch of one voice at a time: all fit the cache.
    mutable AlignedFloats amplitude_rows, rate_rows, mend_rows;
    mutable std::vector<double> angle, cosine, sine;
};

/// The recurrence's rows at a rate [Hz].
void find_steps(StruckVoiceModel& model, double rate);

/// The sound of a rigid body that blows set ringing: its modes by exact recurrence, driven by
/// impulses spread over contact times; and by how these jerk the body as a whole (RigidSound),
/// which is all that is heard of one too small or too stiff to ring.
///
/// Works at the audio rate, half the grid's: modes end at 22 kHz, and images beyond 24 kHz are the
/// decimator's. Blows are told to the recurrence as SampledPulse has them; of short ones, which
/// hold much beyond half the rate, each mode is then given what it lacks of what it has really
/// got, so that what rings on has no image of them. Modes come later by the way from the body's
/// middle to its near side, so that they and the click leave from there together. Of blows that are
/// long for the slowest mode only their click goes on in time: they are felt as at once, by what
/// they hold at each mode's frequency. From the highest down, modes that nobody could hear stand
/// still. A step allocates nothing.
class StruckVoice {
public:
    static constexpr std::size_t kMostPulses = 24; ///< at a time; a further one cuts the oldest off
    static constexpr std::size_t kMostDrives = 8;
    static constexpr int kEvery = 2; ///< samples of the grid for one of these
    /// Rows hold the click's columns, those of modes, and silent ones.
    static std::size_t columns_of(std::size_t modes) noexcept {
        const std::size_t all = ClickColumns::kCount + modes;
        return (all + kModeLanes - 1) / kModeLanes * kModeLanes;
    }

    /// @param rate  of audio [Hz].
    StruckVoice(std::shared_ptr<const StruckVoiceModel> model, double rate);

    /// A blow that begins at `time` [s] and lasts `duration` [s]. What lies before the samples
    /// given off already comes at once.
    /// @param push  of each mode: its shape at the point times the impulse [kg^1/2 m/s].
    /// @param jerk  by how much the body's velocity and spin change, in its frame.
    void strike(double time, double duration, std::span<const float> push,
                const RigidSound::Six& jerk) noexcept;

    /// Forces that last: what each sample after `begin` gives, in [N s] along one direction at one
    /// place. Up to kMostDrives at a time, further ones are not heard. `series` must last until the
    /// next advance(), which takes what there is of it.
    /// @param push, jerk  as in strike(), of 1 N s.
    void drive(std::int64_t begin, std::span<const float> series, std::span<const float> push,
               const RigidSound::Six& jerk) noexcept;
    /// An impulse of a force that is known from moment to moment: at `time` [s], which is not
    /// before that of the last call. What lies before the samples given off already comes at once.
    /// May allocate.
    /// @param push, jerk  as in strike().
    void push(double time, std::span<const double> push, const RigidSound::Six& jerk);
    /// Decays of the modes beside their own until the next call [1/s]. Empty: none.
    void damp(std::span<const float> decay) noexcept;

    /// Gives off all samples from the last pose to this one.
    void advance(const FramePose& pose, BlockSink& out);
    /// Falls silent within ModalVoice::kFadeTime.
    void finish(BlockSink& out);

    bool is_silent() const noexcept {
        return active_ == 0 && pulses_ == 0 && drives_ == 0 && !has_next_ &&
               (!kicks_ || kicks_->is_empty());
    }
    const StruckVoiceModel& model() const noexcept { return *model_; }
    double energy() const noexcept; ///< of all modes [J]
    std::span<const float> rates() const noexcept {
        return std::span(rate_of_).subspan(ClickColumns::kCount);
    } ///< of all modes, and padding

private:
    struct Pulse {
        SampledPulse modes, click;
        AlignedFloats push; ///< columns
        std::size_t modes_heard = 0;
        Vec3 jolt = Vec3::Zero(); ///< of D V, see RigidSound

        std::int64_t last() const noexcept { return std::max(modes.end(), click.end()) - 1; }
    };
    /// Pulses no longer than this are mended: of others images are 90 dB down [samples].
    static constexpr double kMended = 5.0;

    /// For a mode of frequency w, pulses longer than this over w are felt as at once: less than a
    /// twenty-fifth of their impulse.
    static constexpr double kLong = 12.0;

    struct Drive {
        std::int64_t begin = 0;
        std::span<const float> series;
        AlignedFloats push; ///< columns
        std::size_t modes_heard = 0;
        Vec3 jolt = Vec3::Zero();
    };

    /// What acts within a run.
    class Acting;

    /// Of push(): modes later than the click by lead_.
    struct Given {
        Kicks modes, click;
        std::vector<double> push; ///< scratch

        std::int64_t next() const noexcept { return std::min(modes.next(), click.next()); }
        bool is_empty() const noexcept { return modes.is_empty() && click.is_empty(); }
        void close(double time) {
            modes.close(time);
            click.close(time);
        }
    };

    /// Modes up to the highest that reaches its least rate. @param rate  rate(mode): its q'.
    template <class Rate>
    std::size_t heard(std::size_t modes, std::size_t least, Rate rate) const noexcept {
        while (modes > least && !(rate(modes - 1) > model_->least_rate[modes - 1]))
            --modes;
        return modes;
    }
    void run(std::int64_t last, const FramePose& to, bool fading, BlockSink& out);
    void send(std::int64_t first, int samples, const FramePose& to, bool fading, BlockSink& out);
    void give_rest(const Pulse& pulse) noexcept;
    /// What is lacking of a pulse at its last sample. @param q, v  out: columns.
    void mend(const Pulse& pulse, float* q, float* v) const noexcept;
    void ring(std::int64_t first, int samples) noexcept;
    /// Up to a sample; to the state, and to the sample's row.
    void take_kicks(std::int64_t sample, float* q_row, float* v_row) noexcept;
    void settle() noexcept;
    bool clicks() const noexcept; ///< the body as a whole is heard

    std::shared_ptr<const StruckVoiceModel> model_;
    double rate_;
    double lead_;                          ///< of the click before the modes [s]
    AlignedFloats amplitude_, rate_of_;    ///< columns
    std::array<Pulse, kMostPulses> pulse_; ///< pulses_ of them, the oldest first
    std::size_t pulses_ = 0;
    std::array<Drive, kMostDrives> drive_; ///< drives_ of them
    std::size_t drives_ = 0;
    /// Of the click's columns, for the next sample.
    alignas(64) std::array<float, kModeLanes> next_q_{}, next_v_{};
    bool has_next_ = false;
    std::unique_ptr<Given> kicks_; ///< null: nothing was pushed yet
    AlignedFloats damped_step_;    ///< as StruckVoiceModel::step, while contacts damp
    bool damped_ = false;
    std::size_t active_ = 0; ///< columns from the first on that may be heard
    bool begun_ = false;
    FramePose pose_;        ///< at the last call
    std::int64_t done_ = 0; ///< last sample given off
};

} // namespace ode::sound
