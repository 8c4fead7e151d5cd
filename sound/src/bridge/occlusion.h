#pragma once

#include "bridge/rigid_bodies.h"
#include "mix/scene.h"

#include <ode/ode.h>

#include <array>
#include <span>
#include <vector>

namespace ode::sound {

/// Finds out what stands between bodies and ears, by rays through the application's own space.
///
/// Rays go from the middle of each patch of a surface to each ear, in turn, at a bounded rate; none
/// while nothing's box comes near the way. A body does not hide itself: the calibrated rules count
/// all its faces, and what goes round it is their business.
/// Rigid bodies are looked for at the middle of their box and half way to its corners.
class Occlusion {
public:
    static constexpr double kRaysPerSecond = 4000.0; ///< of simulated time
    static constexpr double kLook = 1.0 / 16;        ///< what asking for boxes near the way counts

    Occlusion() = default;
    Occlusion(const Occlusion&) = delete;
    Occlusion& operator=(const Occlusion&) = delete;
    ~Occlusion() { set(nullptr, 0); }

    /// @param space  null: nothing hides anything.
    /// @param hides  category bits of geoms that do.
    void set(dSpaceID space, unsigned long hides);

    /// After a step of `duration` [s]. Soft bodies' keys are dSoftBodyIDs; of rigid ones those that
    /// ring are looked after.
    void update(Scene& scene, const RigidBodies& rigid, double duration);

    unsigned long rays() const noexcept { return rays_; }

private:
    /// A body that may be hidden.
    struct Target {
        const void* key;    ///< of its shades
        BodySource* source; ///< of a soft body
        dGeomID geom;       ///< likewise
        const RigidBody* rigid;
        bool owns(dGeomID other) const noexcept {
            return rigid ? dGeomGetBody(other) == rigid->body : other == geom;
        }
        /// What of it is looked for, world [m]. @return how many.
        int points(std::span<std::array<double, 3>> out) const;
    };
    void list(Scene& scene, const RigidBodies& rigid);
    void look(Listener& listener, const Target& target);
    bool may_hide(const Target& target, const dReal* low, const dReal* high) const;
    bool is_hidden(const Target& target, const Vec3& from, const Vec3& to);
    bool any_near(dSpaceID space, const Target& target, const dReal* low, const dReal* high) const;
    static void meet(void* data, dGeomID a, dGeomID b);

    dSpaceID space_ = nullptr;
    unsigned long hides_ = 0;
    dGeomID ray_ = nullptr;
    std::vector<Target> target_; ///< in this step
    std::vector<dGeomID> soft_;  ///< geoms of soft bodies, which hide from those who list a space
    double credit_ = 0.0;        ///< rays that may be cast
    unsigned long turn_ = 0;     ///< whose ray is next
    unsigned long rays_ = 0;
};

} // namespace ode::sound
