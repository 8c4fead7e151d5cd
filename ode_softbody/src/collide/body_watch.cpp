#include "collide/body_watch.h"

namespace ode::soft {

BodyWatch::BodyWatch(dBodyID body) : geom_(create_soft_geom(nullptr, *this)) {
    dGeomSetBody(geom_, body);
}

BodyWatch::~BodyWatch() {
    if (geom_)
        destroy_soft_geom(geom_);
}

bool BodyWatch::gone() const noexcept { return !geom_ || !dGeomGetBody(geom_); }

} // namespace ode::soft
