#pragma once

#include "listen/pose.h"
#include "mix/limiter.h"
#include "mix/meter.h"
#include "mix/settings.h"
#include "mix/voice_gains.h"
#include "path/ear_line.h"
#include "path/paper_line.h"
#include "path/shade.h"
#include "sink/sink.h"
#include "source/body_source.h"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace ode::sound {

/// One or two ears, what travels to them, and the sinks that get what they hear.
class Listener {
public:
    static constexpr int kEars = 2; ///< at most

    /// @param frame  first audio frame to be heard (time * rate).
    Listener(const Settings& settings, std::int64_t frame);

    /// To be changed at will; heard from the next step on.
    Pose pose;
    /// Of the ears, by it [m]; a single one is in the middle.
    std::array<Vec3, kEars> places() const noexcept;

    int ears() const noexcept { return ears_; }
    /// One, at the middle, or two. What is under way is lost.
    /// @return false, and nothing changed, once there are sinks, which have been told.
    bool set_ears(int ears);

    /// Takes over `pose`: ears go there from `time` [s] on within `duration` [s].
    void begin_step(double time, double duration);

    /// The settings have changed: what is under way is lost.
    void restart();

    void send(const FlowBlock& block) noexcept;
    void send(const FacetBlock& block) noexcept;
    void send(const ModalBlock& block); ///< allocates when a voice is first heard
    void send(const ModalRun& run);     ///< likewise
    void forget_voice(const void* voice) noexcept;

    /// What this listener sees of a source; made at the first call.
    /// @param source  a BodySource, or the StruckVoice of a rigid body.
    Shade& shade(const void* source);
    bool has_shade(const void* source) const noexcept { return find_shade(source) != nullptr; }
    /// The source ends.
    void forget(const BodySource& source) noexcept;

    /// Hands all frames before `frame` to the sinks.
    void render(std::int64_t frame) noexcept;
    /// Frame after the last that anything is under way to.
    std::int64_t last_frame() const noexcept;

    /// The sink stays the caller's; once that lets it go, so does the listener.
    /// @return false when the sink refuses the format; Sink::error() says why.
    bool add_sink(const std::shared_ptr<Sink>& sink);
    void remove_sink(const Sink& sink) noexcept;
    bool has_sink(const Sink& sink) const noexcept;
    /// Those that live. @param use  called with each.
    template <class Use>
    void for_each_sink(Use&& use) const {
        for (const std::weak_ptr<Sink>& own : sinks_)
            if (const std::shared_ptr<Sink> sink = own.lock())
                use(*sink);
    }

    std::int64_t frames() const noexcept { return frames_; }   ///< rendered
    std::int64_t dropped() const noexcept { return dropped_; } ///< not taken by a full sink
    const Meter& meter() const noexcept { return meter_; }     ///< [Pa]

    /// What each ear heard since the last call, and by how much the limiter held it down.
    struct Level {
        std::array<Meter, kEars> ear; ///< [Pa], before the limiter
        double least_gain;            ///< [-]
    };
    Level take_level() noexcept;

    /// @param ceiling  of what sinks get, relative to full scale; 0 takes the limiter away. Where
    /// there is one sinks get all Limiter::kLookAhead later; when it comes or goes they miss or
    /// repeat that much.
    void set_limiter(double ceiling);

private:
    struct Ear {
        std::unique_ptr<EarPath> path;
        std::unique_ptr<EarLine> wave; ///< one of these two, by sampling
        std::unique_ptr<PaperLine> paper;
        Line& line() noexcept { return wave ? static_cast<Line&>(*wave) : *paper; }
    };

    /// @param only  this ear; negative: all.
    void splat(const FlowBlock& block, bool ghost, int only = -1) noexcept;
    struct Voice {
        const void* key;
        std::array<VoiceGains, kEars> gains;
    };
    Voice& find_voice(const void* voice, const TransferTable& table, std::size_t lead = 0);
    /// @param heard  by the ear. @param place, mach  of the ear [m], and its velocity over that of
    /// sound.  @param share  of what it hears that is heard there.
    void send_struck(const ModalRun& run, std::size_t e, const float* heard, const Vec3& place,
                     const Vec3& mach, double share) noexcept;
    struct Shaded {
        const void* source;
        std::unique_ptr<Shade> shade;
    };
    Shade* find_shade(const void* source) const noexcept;

    std::span<Ear> heard() noexcept {
        return std::span(ear_).first(static_cast<std::size_t>(ears_));
    }
    std::span<const Ear> heard() const noexcept {
        return std::span(ear_).first(static_cast<std::size_t>(ears_));
    }

    const Settings* settings_;
    int ears_ = kEars;
    std::int64_t next_;
    std::int64_t frames_ = 0;
    std::int64_t dropped_ = 0;
    std::array<Ear, kEars> ear_;
    std::vector<Voice> voice_;
    std::size_t hint_ = 0; ///< voice of the last block
    std::vector<std::weak_ptr<Sink>> sinks_;
    Meter meter_;
    std::vector<Shaded> shade_;
    std::array<Meter, kEars> ear_meter_;
    std::optional<Limiter> limiter_;
};

} // namespace ode::sound
