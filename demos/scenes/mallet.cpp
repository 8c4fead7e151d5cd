#include "scenes/mallet.h"

#include <algorithm>

namespace scenes {

Mallet::Mallet(World& world, double mass, double radius, const dVector3 at, const dVector3 velocity)
    : body_(dBodyCreate(world.ode())), geom_(dCreateSphere(world.space(), radius)) {
    dMass m;
    dMassSetSphereTotal(&m, mass, radius);
    dBodySetMass(body_, &m);
    dGeomSetBody(geom_, body_);
    dBodySetPosition(body_, at[0], at[1], at[2]);
    dBodySetLinearVel(body_, velocity[0], velocity[1], velocity[2]);
    dBodySetGravityMode(body_, 0);
    std::copy_n(velocity, 3, start_);
    std::copy_n(velocity, 3, last_);
}

void Mallet::watch() {
    if (struck_)
        return;
    const dReal* now = dBodyGetLinearVel(body_);
    double slowed = 0, changed = 0, square = 0;
    for (int k = 0; k < 3; ++k) {
        slowed += (now[k] - start_[k]) * (now[k] - start_[k]);
        changed += (now[k] - last_[k]) * (now[k] - last_[k]);
        square += start_[k] * start_[k];
    }
    std::copy_n(now, 3, last_);
    constexpr double kTouch = 1e-4, kFree = 1e-18; // of its speed, squared
    if (slowed < kTouch * square || changed > kFree * square)
        return;
    struck_ = true;
    dGeomDisable(geom_);
    dBodyDisable(body_);
}

} // namespace scenes
