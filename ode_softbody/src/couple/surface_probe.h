#pragma once

#include "base/types.h"
#include "collide/convex_faces.h"

#include <ode/collision.h>

#include <array>
#include <span>

namespace ode::soft {

/// Asks ODE for the surface near a point, for the kinds of geom whose shape ODE keeps to itself
/// (height field) or that are many triangles (trimesh): the contacts of a small ball with
/// the geom, turned into the tangent planes there. About 1 us; not for every substep.
class SurfaceProbe {
public:
    static constexpr int kMostPlanes = 3; ///< a corner's worth

    /// @param radius  how far the probe feels [m].
    explicit SurfaceProbe(double radius);
    ~SurfaceProbe();
    SurfaceProbe(const SurfaceProbe&) = delete;
    SurfaceProbe& operator=(const SurfaceProbe&) = delete;

    double radius() const noexcept { return radius_; }

    /// @param point  in the geom's own frame [m], outside the solid or little inside.
    /// @param out    planes nearest first; those that all but repeat another are left out.
    /// @return how many; 0 when nothing is near.
    int feel(dGeomID geom, const Vec3& point,
             std::array<TangentPlane, kMostPlanes>& out) const noexcept;

private:
    dGeomID ball_; ///< in no space
    double radius_;
};

} // namespace ode::soft
