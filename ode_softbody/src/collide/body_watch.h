#pragma once

#include "collide/soft_geom.h"

namespace ode::soft {

/// Tells whether a rigid body of the application's still exists: a geom in no space, from which ODE
/// takes the body when that ends.
class BodyWatch final : private SoftGeomClient {
public:
    explicit BodyWatch(dBodyID body);
    ~BodyWatch();
    BodyWatch(const BodyWatch&) = delete;
    BodyWatch& operator=(const BodyWatch&) = delete;

    /// Also when the application has destroyed our geom along with the body's others.
    bool gone() const noexcept;

private:
    Aabb aabb() noexcept override { return Aabb::empty(); }
    void on_pair(dGeomID) noexcept override {}
    int on_ray(dGeomID, int, dContactGeom*, int) noexcept override { return 0; }
    void on_destroyed() noexcept override { geom_ = nullptr; }

    dGeomID geom_;
};

} // namespace ode::soft
