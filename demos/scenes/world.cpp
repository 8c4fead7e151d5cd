#include "scenes/world.h"

#include <array>

namespace scenes {
namespace {

struct Pair {
    dWorldID world;
    dJointGroupID contacts;
};

// Rigid meets rigid: Coulomb friction 0.5 and a hard, slightly elastic contact.
void near_pair(void* data, dGeomID a, dGeomID b) {
    const auto* pair = static_cast<const Pair*>(data);
    std::array<dContact, 8> contact = {};
    const int count = dCollide(a, b, static_cast<int>(contact.size()), &contact[0].geom,
                               static_cast<int>(sizeof(dContact)));
    for (int i = 0; i < count; ++i) {
        dContact& c = contact[static_cast<std::size_t>(i)];
        c.surface.mode = dContactBounce;
        c.surface.mu = 0.5;
        c.surface.bounce = 0.3;
        c.surface.bounce_vel = 0.01; // [m/s]
        dJointAttach(dJointCreateContact(pair->world, pair->contacts, &c), dGeomGetBody(a),
                     dGeomGetBody(b));
    }
}

} // namespace

World::World()
    : ode_(dWorldCreate()), space_(dHashSpaceCreate(nullptr)), contacts_(dJointGroupCreate(0)),
      soft_(dSoftWorldCreate(ode_, space_)) {
    dWorldSetGravity(ode_, 0, 0, -9.81);
    if (!soft_) {
        dJointGroupDestroy(contacts_);
        dSpaceDestroy(space_);
        dWorldDestroy(ode_);
        throw Refused("no soft world");
    }
}

World::~World() {
    dSoftWorldDestroy(soft_);
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dWorldDestroy(ode_);
}

void World::step(double h) {
    Pair pair{ode_, contacts_};
    dSpaceCollide(space_, &pair, near_pair);
    if (!dWorldQuickStep(ode_, h))
        throw Refused("the world could not be stepped");
    dJointGroupEmpty(contacts_);
}

} // namespace scenes
