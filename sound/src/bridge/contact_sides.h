#pragma once

#include "bridge/rigid_touch.h"
#include "strike/hertz.h"
#include "strike/roughness.h"

#include <algorithm>
#include <map>
#include <memory>

namespace ode::sound {

/// What a geom's surface is like where others touch it.
struct Skin {
    std::shared_ptr<const Roughness> roughness;
    double loss = 0.1; ///< factor of contacts with it [-]
};

/// What geoms are made of, as far as the application has told.
class Geoms {
public:
    Geoms();
    /// @param geom  null: all not told of.
    void set_elastic(dGeomID geom, const Elastic& elastic);
    void set_skin(dGeomID geom, const Skin& skin);

    const Elastic& elastic(dGeomID geom) const noexcept;
    const Skin& skin(dGeomID geom) const noexcept;

private:
    std::map<dGeomID, Elastic> elastic_;
    std::map<dGeomID, Skin> skin_;
    Elastic default_elastic_;
    Skin default_skin_;
};

/// Mean curvature of a geom that has no mesh here [1/m].
double curvature_of(dGeomID geom) noexcept;

/// Curvature of a round geom where and how it rolls: across the axis of a capsule or a cylinder;
/// 0 for all that doesn't roll.
/// @param normal  of the contact, world.
double rolling_curvature(dGeomID geom, const Vec3& normal) noexcept;

struct RigidBody;

/// Where two bodies touch, and what of.
struct ContactPatch {
    StruckSurface::Place place[2]; ///< of those with a voice
    double curvature;              ///< of both together [1/m]
    double modulus;                ///< E* of both [Pa]
    double loss;                   ///< factor of the contact: the mean of both [-]
};
/// @param side  those with a voice; null: none.
ContactPatch patch_of(const RigidTouch& touch, RigidBody* const side[2], const Geoms& geoms);

/// Force on the first body per load along the normal: friction goes with the load. Where that is
/// next to nothing the joint's own ratio may be anything; no more than 1 is believed.
Vec3 force_per_load(const RigidTouch& touch) noexcept;

/// How fast a contact goes along both surfaces, tangential and world [m/s]: what rolls takes it
/// along on both, what slides on one (the kinematics of rolling; D. J. Montana, Int. J. Robotics
/// Research 7, 1988). @param load  along the normal [N].
struct Travel {
    Vec3 along[2]; ///< of each body's surface
    double speed() const noexcept { return std::max(along[0].norm(), along[1].norm()); }
};
Travel travel_of(const RigidTouch& touch, double load) noexcept;

} // namespace ode::sound
