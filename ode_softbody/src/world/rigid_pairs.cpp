#include "world/rigid_pairs.h"

#include "base/error.h"
#include "collide/shape_fault.h"
#include "world/body.h"
#include "world/soft_world.h"

#include <ode/collision.h>

#include <algorithm>

namespace ode::soft {

bool Said::first(const void* thing) {
    if (std::find(thing_.begin(), thing_.end(), thing) != thing_.end())
        return false;
    thing_.push_back(thing);
    return true;
}

void choose_pairs(Body& body, std::span<const dGeomID> met, const ContactChooser& chooser,
                  Said& said, std::vector<RigidPair>& chosen) {
    chosen.clear();
    for (const dGeomID geom : met) {
        if (Body::behind(geom) || body.world().attachments().has(body, dGeomGetBody(geom)))
            continue;
        if (!shape_is_sound(geom)) {
            if (said.first(geom))
                report(geom_name(geom) + " " + shape_fault(geom) +
                       "; soft bodies pass through it until then");
            continue;
        }
        RigidPair pair{geom, body.contact_law()};
        if (!chooser || chooser(body, geom, pair.law))
            chosen.push_back(pair);
    }
}

} // namespace ode::soft
