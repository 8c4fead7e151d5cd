#pragma once

#include "collide/aabb.h"

#include <ode/collision.h>
#include <ode/collision_space.h>
#include <ode/contact.h>

namespace ode::soft {

/// What stands behind a soft geom in ODE's space. Called on the thread that collides the space,
/// with the space locked: touch no geom or space from within.
class SoftGeomClient {
public:
    /// Current box, grown by as far as the surface may move before the next collision pass.
    /// Asked for only after mark_moved(). An empty box keeps the geom where nothing is.
    virtual Aabb aabb() noexcept = 0;

    /// The boxes of this geom and `other` overlap. `other` is never a space, a ray or a disabled
    /// geom; it may be another soft geom, and then only one of the two is told. It may be told
    /// more than once for one pair.
    virtual void on_pair(dGeomID other) noexcept = 0;

    /// A ray meets the geom's box. Contacts as for dCollide(): g1 and side1 are the soft geom's.
    /// collide_ray() does this for a triangle surface.
    /// @param skip  bytes from contact to contact.
    /// @return contacts written, at most flags & 0xffff.
    virtual int on_ray(dGeomID ray, int flags, dContactGeom* contact, int skip) noexcept = 0;

    /// The application has destroyed the geom or its space: the id is void from now on.
    virtual void on_destroyed() noexcept = 0;

protected:
    ~SoftGeomClient() = default;
};

/// Puts a geom for `client` in `space`. All soft bodies share one user class of ODE's four.
/// The geom is seen by no near callback: its pairs are taken from aabb_test, which then says "no
/// overlap"; nested spaces are searched from there. Rays alone collide in the ordinary way.
/// @param space   may be NULL: the geom then only meets what it is collided with by name.
/// @param client  borrowed until on_destroyed() or destroy_soft_geom().
/// Ends in ODE's dDebug when the application has taken all four user classes.
dGeomID create_soft_geom(dSpaceID space, SoftGeomClient& client);

/// Destroys the geom without telling its client.
void destroy_soft_geom(dGeomID geom) noexcept;

/// Makes ODE ask for the box again at the next collision pass. Not while the space is locked.
void mark_moved(dGeomID geom) noexcept;

/// nullptr for any geom that create_soft_geom() did not make.
SoftGeomClient* soft_geom_client(dGeomID geom) noexcept;

/// Whether it is one of ours. @param geom  of any kind; it exists.
bool is_soft_geom(dGeomID geom) noexcept;

/// How many of ours lie in a space itself, those in spaces within not counted.
int soft_geoms_in(dSpaceID space) noexcept;

/// The space that holds the geom, over any number of spaces between; the geom itself when it lies
/// in none.
dGeomID topmost(dGeomID geom) noexcept;

/// Whether all geoms of a space can be asked at once by collide_all(): it holds no other space, and
/// can be listed.
bool is_flat(dSpaceID space) noexcept;
/// All pairs of a flat space at once: where many soft geoms are in it, each would ask all others.
void collide_all(dSpaceID space) noexcept;
/// Makes the geom meet everything in the topmost space it lies in. No near callback is involved.
void collide_now(dGeomID geom) noexcept;

/// Makes the geom meet another geom, or everything in a space.
void collide_with(dGeomID geom, dGeomID other) noexcept;

/// ODE is being closed: class numbers start afresh. Without this call the next create_soft_geom()
/// finds out by itself, by probing the geom class that now has the number.
void forget_soft_class() noexcept;

} // namespace ode::soft
