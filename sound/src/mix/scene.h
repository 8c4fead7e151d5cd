#pragma once

#include "mix/listener.h"
#include "source/body_source.h"
#include "source/modal_voice.h"
#include "source/struck_voice.h"

#include <memory>
#include <vector>

namespace ode::sound {

/// All that sounds and all that hear it, in step with a world's clock.
///
/// Bodies are known by an address that the caller chooses. Substeps of different bodies may come in
/// any order within a step. Stepping thread. Allocates when a body or a listener is first seen.
class Scene final : private BlockSink {
public:
    struct Count {
        unsigned long substeps = 0;
        unsigned long gathers = 0;
        unsigned long modal_views = 0;
        unsigned long mode_samples = 0;      ///< modes times samples given off
        unsigned long inaudible_samples = 0; ///< left out of them
        unsigned long frames = 0;
        double peak = 0.0; ///< [Pa]
        double rms = 0.0;  ///< [Pa]
    };

    Scene();
    ~Scene() override;
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    const Settings& settings() const noexcept { return settings_; }
    /// What is under way is lost when anything but full scale changes.
    void set(const Settings& settings);

    /// @param time  of the world now [s].
    Listener& add_listener(double time);
    void remove_listener(Listener& listener) noexcept;
    std::size_t listeners() const noexcept { return listeners_.size(); }

    /// Whether a substep of the body has come before: the first takes far longer than the others.
    bool has_heard(const void* body) noexcept {
        const Body* own = known(body);
        return own && own->heard;
    }
    /// One substep of one body. @param triangle  as in Surface; read at the first substep alone.
    void push(const void* body, std::span<const int> triangle, const SurfaceView& view);
    /// The same of a body that moves in its modes. @param model  asked for at the first view alone.
    template <class Model>
    void push(const void* body, std::span<const int> triangle, const ModalView& view, Model model) {
        if (!stepping_)
            begin_step(view.time - view.dt);
        ++count_.modal_views;
        Body& own = find(body, triangle);
        if (own.gain == 0.0 && own.now == 0.0)
            return;
        const std::shared_ptr<const ModalVoiceModel> wanted = model();
        if (own.voice && &own.voice->model() != wanted.get())
            end_voice(own);
        if (!own.voice)
            own.voice = std::make_unique<ModalVoice>(wanted, settings_.send_rate());
        sounding_ = &own;
        own.voice->push(view, nearest_ear(view.center), *this);
    }
    /// A rigid body that sounds when it is struck; the scene's, until end_body(), set() or the last
    /// listener goes.
    StruckVoice& add_struck(const void* body, std::shared_ptr<const StruckVoiceModel> model);
    StruckVoice* find_struck(const void* body) noexcept;
    /// The same. @param likely  where it was found last; kept.
    StruckVoice* find_struck(const void* body, std::size_t& likely) noexcept;
    /// Lets rigid bodies give off what they did. @param pose  of a body, by its address.
    template <class Pose>
    void advance_struck(Pose pose) {
        for (Body& own : bodies_)
            if (own.struck && own.key) {
                sounding_ = &own;
                own.struck->advance(pose(own.key), *this);
            }
    }

    /// How loud a body is from now on; 1 as it is, 0 silent, and then it costs nothing. Reached in
    /// kGainTime, without a click. May come before the body's first substep.
    void set_gain(const void* body, double gain);
    double gain(const void* body) const noexcept;
    static constexpr double kGainTime = 5e-3; ///< [s], from 0 to 1

    /// Bodies that have not ended: use(key, source).
    template <class Use>
    void for_each_body(Use&& use) {
        for (Body& body : bodies_)
            if (body.key && body.source)
                use(body.key, *body.source);
    }

    /// The body will come no more; its address may be used anew.
    void end_body(const void* body) noexcept;
    /// All substeps up to `time` [s] have come, and rigid bodies have been advanced to `settled`,
    /// which may be earlier: what is heard is worked out as far as nothing can be added.
    void end_step(double time, double settled);
    void end_step(double time) { end_step(time, time); }
    /// Plays out what still travels. push() may follow, at a later time.
    void finish();

    Count count() const noexcept;
    const std::vector<std::unique_ptr<Listener>>& all() const noexcept { return listeners_; }

private:
    struct Body {
        const void* key;                     ///< null once it has ended
        std::unique_ptr<BodySource> source;  ///< of its surface; null for a rigid body
        std::unique_ptr<ModalVoice> voice;   ///< of its modes; null: it never moved in them
        std::unique_ptr<StruckVoice> struck; ///< of a rigid body
        bool is_silent() const noexcept {
            return (!source || source->is_silent()) && (!voice || voice->is_silent()) &&
                   (!struck || struck->is_silent());
        }
        double gain;        ///< wanted
        double now;         ///< heard
        bool heard = false; ///< by its nodes, at least once
    };
    struct Gain {
        const void* key;
        double gain;
    };

    void on_flow(const FlowBlock& block) noexcept override;
    void on_facets(const FacetBlock& block) noexcept override;
    void on_modes(const ModalBlock& block) noexcept override;
    void on_modal_run(const ModalRun& run) noexcept override;
    void end_voice(Body& body) noexcept;
    double nearest_ear(const Vec3& place) const noexcept; ///< [m]; infinite: there is none
    double next_gain(double samples_per_second) noexcept;
    Body* known(const void* body) noexcept;
    Body& find(const void* body, std::span<const int> triangle);
    void begin_step(double time);

    Settings settings_;
    std::vector<std::unique_ptr<Listener>> listeners_;
    std::vector<Body> bodies_;
    std::vector<Gain> gain_;   ///< those that differ from 1
    Body* sounding_ = nullptr; ///< gives off at present
    std::size_t hint_ = 0;     ///< body of the last push
    bool stepping_ = false;    ///< between the first substep and end_step()
    double time_ = 0.0;        ///< end of the last step [s]
    double duration_ = 0.0;    ///< of the last step [s]
    Count count_;
    Meter gone_; ///< of listeners removed
};

} // namespace ode::sound
