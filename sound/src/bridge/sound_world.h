#pragma once

#include "bridge/occlusion.h"
#include "bridge/pace.h"
#include "bridge/rigid_bodies.h"
#include "mix/alarm.h"
#include "mix/cpu_clock.h"
#include "mix/scene.h"

#include <ode_softbody/softbody.h>

#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace ode::sound {

/// Carries a soft world's substeps to a scene. Registered as an observer while somebody listens,
/// and only then. Either world may end first.
class SoundWorld {
public:
    explicit SoundWorld(dSoftWorldID world);
    ~SoundWorld();
    SoundWorld(const SoundWorld&) = delete;
    SoundWorld& operator=(const SoundWorld&) = delete;

    Scene& scene() noexcept { return scene_; }
    const Scene& scene() const noexcept { return scene_; }

    /// As Scene::set().
    void set(const Settings& settings);
    Occlusion& occlusion() noexcept { return occlusion_; }
    Pace& pace() noexcept { return pace_; }
    /// What the pace policy asks for, between steps.
    void keep_pace();
    unsigned long underruns() const noexcept; ///< of all sinks
    const Alarm& alarm() const noexcept { return alarm_; }
    /// @param tell  besides the message; may be empty.
    void set_alarm(std::function<void(dSoftBodyID, double)> tell) { tell_ = std::move(tell); }

    Listener& add_listener();
    void remove_listener(Listener& listener) noexcept;

    RigidBodies& rigid() noexcept { return rigid_; }
    std::shared_ptr<RigidBody> add_rigid(dBodyID body, std::shared_ptr<const RigidModel> model);
    /// A blow that no joint deals, at the present time. World frame.
    void strike(RigidBody& body, const Vec3& point, const Vec3& impulse, double contact);
    RigidModels& rigid_models() noexcept { return rigid_models_; }
    dSoftWorldID soft_world() const noexcept { return world_; }

    /// Lets the soft world go, plays out what still travels and closes the sinks of all listeners.
    /// Nothing is heard after. Idempotent.
    void end() noexcept;

    /// Spent on sound [s]; substeps are sampled.
    double seconds() const noexcept { return cost_.seconds(); }

    // What the soft world tells; public for tests, which have none.
    void on_substep(const dSoftSubstep& substep) noexcept;
    void on_modal(const dSoftModalState& state) noexcept;
    void on_rigid_pushes(const dSoftRigidPushes& pushes) noexcept;
    void on_step(double time) noexcept;
    void on_moved(double time) noexcept;
    void on_body_end(dSoftBodyID body) noexcept;
    void on_world_end() noexcept;

private:
    void observe();
    void end_step(double time, double settled);
    void ignore() noexcept;
    void play_out() noexcept;
    void raise(const void* body, double time, Alarm::Cause cause);
    std::shared_ptr<const ModalVoiceModel> voice_model(dSoftBodyID body);

    dSoftWorldID world_; ///< null once it has ended
    bool observing_ = false;
    bool ended_ = false;
    bool failed_ = false; ///< out of memory, and told so
    Scene scene_;
    /// By the identity of their modes, while some voice has them.
    std::map<const void*, std::weak_ptr<const ModalVoiceModel>> voice_model_;
    RigidModels rigid_models_;
    RigidBodies rigid_;
    bool follows_rigid_ = false; ///< in this step
    Occlusion occlusion_;
    Alarm alarm_;
    Pace pace_;
    std::function<void(dSoftBodyID, double)> tell_;
    double stepped_ = 0.0; ///< end of the last step [s]
    SampledCost cost_;
    std::vector<double> padded_; ///< positions, then velocities, where the stride is three
};

} // namespace ode::sound
