#pragma once

#include "bridge/blow.h"
#include "bridge/contact_sides.h"
#include "bridge/rigid_model.h"
#include "bridge/rigid_scrapes.h"
#include "bridge/rigid_touch.h"
#include "bridge/soft_pushes.h"
#include "bridge/spots.h"
#include "mix/scene.h"

#include <array>
#include <memory>
#include <vector>

namespace ode::sound {

/// A rigid body that sounds.
struct RigidBody {
    dBodyID body; ///< null once it has ended
    dSoftRigidWatchID watch;
    std::shared_ptr<const RigidModel> model;
    FramePose before; ///< when the present step began

    /// Where it touched something lately, so that what rests is not heard to strike again and
    /// again.
    struct Known {
        const void* partner; ///< geom or body; null: the ground
        Vec3 local;          ///< in the body's frame [m]
        Vec3 world;          ///< [m]
        double seen;         ///< [s]
        double load = 0.0;   ///< see History
        int steps = 0;
    };
    std::vector<Known> known;
    std::vector<float> push; ///< scratch, one a mode
    Spots spots;             ///< where it was touched lately
    /// Contacts that damp it in one step at most; two hold it as well as ten.
    static constexpr int kMostBearings = 4;
    int bearings = 0;                        ///< in this step
    bool damped = false;                     ///< in the step before
    bool heard_soft = false;                 ///< what pushes it is news
    std::vector<float> damping;              ///< of each mode by them [1/s]
    std::array<std::vector<float>, 3> shape; ///< scratch, along three ways
    mutable std::size_t place_in_scene = 0;  ///< likely
    unsigned long blows = 0;                 ///< that it got
};

/// Blows that two bodies deal each other in one step and nearly at once: one pulse of the sum. What
/// each gives the modes stands in RigidBody::push of either side.
struct Stroke {
    /// Two clicks closer than this are heard as one [s] (I. J. Hirsh, J. Acoust. Soc. Am. 31, 1959:
    /// 2 ms).
    static constexpr double kAtOnce = 1e-3;

    RigidBody* side[2] = {}; ///< null: has no voice
    const void* partner = nullptr;
    double given = 0.0;      ///< sum of impulses [N s]; 0: there is no stroke
    double time = 0.0;       ///< mean, weighed by impulse [s]
    double duration = 0.0;   ///< likewise
    double energy = 0.0;     ///< sum [J]
    RigidSound::Six jerk[2]; ///< in each body's frame
};

/// Rigid bodies that sound, and the blows that ODE's contact joints deal them.
///
/// Voices lag a step behind: ODE finds a contact when bodies overlap already, so that the blow fell
/// in the step before, at a time that depth and closing speed tell.
class RigidBodies {
public:
    RigidBodies() = default;
    ~RigidBodies();
    RigidBodies(const RigidBodies&) = delete;
    RigidBodies& operator=(const RigidBodies&) = delete;

    std::shared_ptr<RigidBody> add(dBodyID body, std::shared_ptr<const RigidModel> model);
    void remove(RigidBody& body, Scene& scene) noexcept;
    bool has(dBodyID body) const noexcept { return find(body) != nullptr; }
    bool empty() const noexcept { return body_.empty(); }
    template <class Use>
    void for_each(Use&& use) const {
        for (const auto& own : body_)
            use(*own);
    }

    Geoms& geoms() noexcept { return geoms_; }

    /// Before ODE's step, from `time` on. @param scene  takes the voices of bodies that have ended.
    void begin_step(dSoftWorldID world, double time, Scene& scene);
    /// After ODE's step to `time`: blows are dealt, and voices advanced to the time when the step
    /// began.
    void end_step(double time, Scene& scene, RigidModels& models);

    /// What soft bodies did in a substep.
    void feel(const dSoftRigidPushes& pushes, Scene& scene, RigidModels& models);
    void forget(dSoftBodyID soft) noexcept { pushes_.forget(soft); }
    /// Nobody listens any more, or to something else.
    void fall_silent() noexcept {
        pushes_.clear();
        for (const auto& own : body_)
            own->heard_soft = false;
    }

    /// World frame; `time` is now [s].
    void strike(RigidBody& body, const Vec3& point, const Vec3& impulse, double contact,
                double time, Scene& scene, RigidModels& models) const;

    StruckVoice& voice(const RigidBody& body, Scene& scene, RigidModels& models) const;

private:
    void list();
    RigidBody* find(dBodyID body) const noexcept;
    void meet(RigidTouch& touch, double h, Scene& scene, RigidModels& models);
    void fall(const RigidTouch& touch, RigidBody* const side[2], const void* partner,
              const Blow& blow, double h, Scene& scene, RigidModels& models);
    void fall_passed(double h, Scene& scene, RigidModels& models);
    /// A contact that bears a load: it damps what rings (by its share of the strain energy: E. E.
    /// Ungar, E. M. Kerwin, J. Acoust. Soc. Am. 34, 1962) and, sliding or rolling, makes it sound.
    void bear(const RigidTouch& touch, RigidBody* const side[2], const void* partner, double load,
              Scene& scene, RigidModels& models);
    /// Lets the pending stroke be heard.
    void deal(Scene& scene, RigidModels& models);
    bool locate(RigidTouch& touch) const noexcept;

    std::vector<std::shared_ptr<RigidBody>> body_;
    std::vector<std::pair<dBodyID, std::size_t>> order_; ///< by address; index in body_
    Geoms geoms_;
    RigidTouches touches_;
    RigidScrapes scrapes_;
    SoftPushes pushes_;
    struct Fell {
        dBodyID body[2];
        double time; ///< [s]
    };
    std::vector<Fell> fell_; ///< blows of this step
    struct Passed {
        const RigidTouch* touch;
        RigidBody* side[2];
        const void* partner;
        Blow blow;
    };
    std::vector<Passed> passed_; ///< blows through contacts that bore, of this step
    Stroke stroke_;              ///< not dealt yet
    double begin_ = 0.0;         ///< of the present step [s]
    double before_ = 0.0;        ///< length of the step before [s]
};

} // namespace ode::sound
