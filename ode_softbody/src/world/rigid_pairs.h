#pragma once

#include "couple/contact_law.h"

#include <ode/common.h>

#include <functional>
#include <span>
#include <vector>

namespace ode::soft {

class Body;

/// A rigid geom that a soft body meets in a step, and how they meet.
struct RigidPair {
    dGeomID geom;
    ContactLaw law;
};

/// The application's word on one pair: changes the law that the soft body would have given, or
/// returns false for no contact. Called once a pair and step, before any substep; neither throws
/// nor changes the world.
using ContactChooser = std::function<bool(Body& soft, dGeomID rigid, ContactLaw& law)>;

/// What has been said once about a thing of the application's and isn't said again.
class Said {
public:
    /// @return whether this is the first time.
    bool first(const void* thing);

private:
    std::vector<const void*> thing_;
};

/// Of the geoms that a body met, those that bear contact: rigid ones in a finite state that the
/// application doesn't refuse. Allocates for a first complaint and for more pairs than ever before.
void choose_pairs(Body& body, std::span<const dGeomID> met, const ContactChooser& chooser,
                  Said& said, std::vector<RigidPair>& chosen);

} // namespace ode::soft
