#pragma once

#include "source/body_source.h"
#include "source/flow_fade.h"
#include "source/flow_history.h"
#include "source/growth_watch.h"
#include "source/lean.h"
#include "source/place_history.h"

#include <optional>

namespace ode::sound {

/// Sampling "sinc": displacement differences, low-passed on to a grid of twice the audio rate.
///
/// Every few substeps (about eight times an audio sample) each node's displacement since the last
/// time is projected on its area vector: the volume swept. That is the box-filtered velocity,
/// exactly, from a difference of positions. Area vectors are taken anew every other audio sample
/// and extrapolated to the middle of the next, so that a turning body does not seem to breathe.
class SurfaceFlow final : public BodySource {
public:
    /// Latest that a grid sample is given off after its own time, for substeps up to 167 us at 48
    /// kHz [grid samples].
    static constexpr int kLag = 112;
    static constexpr int kOversampling = 2;

    /// @param rate   audio rate [Hz].
    /// @param speed  of sound [m/s], for what leans.
    SurfaceFlow(std::span<const int> triangle, double rate, Leaning leaning = Leaning::kNone,
                double speed = 343.0);

    bool push(const SurfaceView& view, BlockSink& out) override;
    void advance_to(double time, BlockSink& out) override;
    const Patches& patches(std::span<std::array<double, 3>> centre) override;
    bool is_silent() const noexcept override { return state_ == State::kSilent; }
    int lag() const noexcept override { return lag_; }
    double grown_at() const noexcept override { return grown_at_; }

private:
    enum class State {
        kSilent,  ///< asleep, or not seen yet; all has been given off
        kMoving,  ///< substeps come
        kResting, ///< substeps have ceased; the end is being given off
    };

    void wake(const SurfaceView& view, BlockSink& out);
    void start(double time);
    void adapt(double substep);
    double wanted() const noexcept; ///< between gathers [s]
    bool is_shortest() const noexcept;
    void rewind(const SurfaceView& view, double duration);
    bool has_jumped(const SurfaceView& view, double duration) const noexcept;
    void record(const SurfaceView& view, BlockSink& out);
    void refresh_areas(double time);
    void stop();
    void rest_until(double time, BlockSink& out);
    void give_off(BlockSink& out);

    Surface surface_;
    double rate_;      ///< audio [Hz]
    double grid_rate_; ///< [Hz]
    State state_ = State::kSilent;
    bool entering_ = false; ///< the next interval is the first after a break

    double interval_;           ///< wanted between gathers [s]
    double stretch_ = 1.0;      ///< of the low-pass, for bodies of long substeps
    int lag_ = kLag;            ///< [grid samples]
    double seen_ = 0.0;         ///< end of the last substep [s]
    double substep_ = 0.0;      ///< its length [s]
    double last_length_ = 0.0;  ///< of the last interval [s]
    double uneven_until_ = 0.0; ///< intervals differed in length not long before [s]
    double dense_until_ = 0.0;  ///< they did so by themselves, and are halved [s]
    bool was_dense_ = false;    ///< the last one was
    double event_end_ = 0.0;    ///< end of the last interval [s]
    double rest_begin_ = 0.0;   ///< [s]
    double refreshed_ = 0.0;    ///< when the areas were taken [s]
    std::int64_t next_ = 0;     ///< grid sample that is given off next

    Leaning leaning_;
    double speed_;
    std::optional<Lean> lean_; ///< from the first view on
    Patches patches_;
    FlowHistory history_;
    GrowthWatch watch_;
    bool was_fresh_ = false;      ///< the last interval was the first with its areas
    double grown_at_ = -HUGE_VAL; ///< [s]
    FlowFade fade_;
    PlaceHistory places_;
    AlignedVector last_;      ///< points at event_end_ [m]
    AlignedVector area_;      ///< area vectors extrapolated to the interval in progress [m^2]
    AlignedVector area_seen_; ///< as last taken [m^2]
    AlignedVector softening_;
    AlignedVector flow_; ///< four grid samples
};

} // namespace ode::sound
