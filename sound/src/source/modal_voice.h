#pragma once

#include "source/body_source.h"
#include "source/resonators.h"
#include "source/rigid_sound.h"
#include "source/rigid_way.h"
#include "transfer/transfer_table.h"

#include <memory>

namespace ode::sound {

/// A body's modes at the end of a substep: since the view before they have rung freely, but for a
/// push at the beginning of a short one. Borrowed.
struct ModalView {
    double time; ///< [s]
    double dt;   ///< [s]
    std::span<const double> amplitude, rate;
    Vec3 center;                  ///< of the body's frame [m]
    Eigen::Matrix3d rotation;     ///< from the frame to the world
    Vec3 velocity = Vec3::Zero(); ///< of the centre, world [m/s]
    Vec3 spin = Vec3::Zero();     ///< world [rad/s]
};

/// Pressure of a mode or a click that is left out [Pa]: 20 dB below the threshold of hearing.
inline constexpr double kInaudible = 2e-6;

/// What bodies that share their modes share of their sound.
struct ModalVoiceModel {
    std::vector<double> omega; ///< [rad/s]
    std::vector<double> decay; ///< [1/s]
    TransferTable table;       ///< in the body's frame
    RigidSound rigid;
    /// Of each mode: pressure at 1 m per unit of its acceleration, mean square of six directions
    /// [Pa s^2 / (kg^1/2 m)].
    std::vector<double> level;
};

/// The sound of a body that moves in its modes: amplitudes at the samples of the grid, which the
/// listener weighs with the gains of its direction. No node is looked at.
///
/// Where views set in or break off (the body changes tier, ends or falls asleep) the amplitudes
/// there are faded out of what follows, or added to it, fading, as FlowFade does to a surface: what
/// a surface has begun goes on without a click.
class ModalVoice {
public:
    static constexpr double kFadeTime = 5e-3; ///< [s], half a cosine

    /// @param rate  of the grid [Hz].
    ModalVoice(std::shared_ptr<const ModalVoiceModel> model, double rate);

    /// @param nearest  of all ears [m]: from the highest mode down, what is inaudible there is left
    ///                 out.
    void push(const ModalView& view, double nearest, BlockSink& out);
    /// No view will come before `time` [s].
    void advance_to(double time, BlockSink& out);
    bool is_silent() const noexcept { return state_ == State::kSilent; }
    std::size_t modes() const noexcept { return model_->omega.size(); }
    const ModalVoiceModel& model() const noexcept { return *model_; }

private:
    enum class State { kSilent, kRinging, kFading };

    void start(const ModalView& view);
    /// @return modes that are heard at such a distance [m], and all below the highest of them.
    std::size_t audible(const ModalView& view, double nearest) const noexcept;
    /// What is known between the last view and this one.
    void ring_back(const ModalView& view, std::int64_t sample, BlockSink& out);
    void ring_on(const ModalView& view, std::int64_t first, std::int64_t last, BlockSink& out);
    void emit_at(const ModalView& view, std::int64_t sample, BlockSink& out);
    void emit(std::int64_t sample, const double* amplitude, const double* rate, BlockSink& out);
    double fade_at(double time) const noexcept; ///< 1 at fade_begin_, 0 after kFadeTime

    std::shared_ptr<const ModalVoiceModel> model_;
    double rate_; ///< of the grid [Hz]
    Resonators resonators_, undamped_;
    State state_ = State::kSilent;
    double seen_ = 0.0; ///< time of the last view [s]
    double fade_begin_ = 0.0;
    bool entering_ = false;
    std::size_t heard_ = 0;             ///< modes, between the last view and the next
    std::size_t heard_at_view_ = 0;     ///< at the last one
    AlignedVector amplitude_, rate_of_; ///< at the last view
    AlignedVector break_amplitude_, break_rate_;
    AlignedVector ring_amplitude_, ring_rate_; ///< scratch: on the grid
    AlignedVector miss_amplitude_, miss_rate_; ///< scratch: of free ringing at the view
    AlignedVector held_amplitude_, held_rate_; ///< scratch: given off
    std::vector<float> sent_amplitude_, sent_rate_;
    RigidWay way_;
    Vec3 center_ = Vec3::Zero();
    Vec3 before_ = Vec3::Zero();
    Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
    Eigen::Matrix3d turned_ = Eigen::Matrix3d::Identity(); ///< rotation_ at the last view
};

} // namespace ode::sound
