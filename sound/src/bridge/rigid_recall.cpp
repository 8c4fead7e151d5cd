#include "bridge/rigid_recall.h"

#include <algorithm>

namespace ode::sound {
namespace {

bool overlap(dGeomID a, dGeomID b) {
    dReal x[6], y[6];
    dGeomGetAABB(a, x);
    dGeomGetAABB(b, y);
    for (int k = 0; k < 6; k += 2)
        if (x[k] > y[k + 1] || y[k] > x[k + 1])
            return false;
    return true;
}

/// Rays, spaces and classes of the application's own are no bodies' surfaces.
bool is_solid(dGeomID geom) {
    const int kind = dGeomGetClass(geom);
    return dGeomIsEnabled(geom) && kind != dRayClass && kind < dFirstSpaceClass;
}

void meet(dGeomID a, dGeomID b, std::vector<RecalledContact>& out) {
    if (!is_solid(a) || !is_solid(b) || !overlap(a, b))
        return;
    constexpr int kMost = 16;
    dContactGeom found[kMost];
    const int count = dCollide(a, b, kMost, found, sizeof found[0]);
    for (int i = 0; i < count; ++i) {
        const bool crossed = found[i].g1 != a && dGeomGetBody(found[i].g1) != dGeomGetBody(a);
        const Vec3 normal(found[i].normal);
        out.push_back(
            {{a, b}, Vec3(found[i].pos), crossed ? Vec3(-normal) : normal, found[i].depth});
    }
}

template <class Use>
void for_each_geom(dSpaceID space, Use&& use) {
    for (int i = 0; i < dSpaceGetNumGeoms(space); ++i) {
        const dGeomID geom = dSpaceGetGeom(space, i);
        if (dGeomIsSpace(geom))
            for_each_geom(reinterpret_cast<dSpaceID>(geom), use);
        else
            use(geom);
    }
}

} // namespace

void recall_contacts(dBodyID first, dBodyID second, std::vector<RecalledContact>& out) {
    for (dGeomID own = dBodyGetFirstGeom(first); own; own = dBodyGetNextGeom(own)) {
        if (second) {
            for (dGeomID other = dBodyGetFirstGeom(second); other; other = dBodyGetNextGeom(other))
                meet(own, other, out);
            continue;
        }
        dSpaceID space = dGeomGetSpace(own);
        while (space && dGeomGetSpace(reinterpret_cast<dGeomID>(space)))
            space = dGeomGetSpace(reinterpret_cast<dGeomID>(space));
        if (space)
            for_each_geom(space, [&](dGeomID other) {
                if (!dGeomGetBody(other))
                    meet(own, other, out);
            });
    }
}

} // namespace ode::sound
