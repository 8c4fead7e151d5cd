#include "collide/soft_geom.h"

#include <algorithm>
#include <mutex>
#include <unordered_set>

namespace ode::soft {
namespace {

/// ODE's storage behind a user geom; ODE zeroes it.
struct GeomData {
    SoftGeomClient* client; ///< nullptr: a probe, or let go
    bool empty;             ///< the client has no box: the geom meets nothing
};

std::mutex lock; // guards `live`: worlds may be stepped from several threads
std::unordered_set<dGeomID>& live_geoms() {
    static std::unordered_set<dGeomID> live;
    return live;
}

int class_number = 0;     ///< 0: not registered
bool probe_heard = false; ///< see is_registered()

GeomData& data_of(dGeomID geom) noexcept {
    return *static_cast<GeomData*>(dGeomGetClassData(geom));
}

void ignore_pair(void*, dGeomID, dGeomID) {}

void compute_aabb(dGeomID geom, dReal box[6]) {
    GeomData& data = data_of(geom);
    const Aabb b = data.client ? data.client->aabb() : Aabb::empty();
    data.empty = b.is_empty() || !b.low.allFinite() || !b.high.allFinite();
    for (int axis = 0; axis < 3; ++axis) {
        box[2 * axis] = data.empty ? 0 : b.low[axis];
        box[2 * axis + 1] = data.empty ? 0 : b.high[axis];
    }
}

/// Called by ODE for every geom whose box overlaps, just before the near callback; 0 keeps the pair
/// from the callback.
int record_pair(dGeomID self, dGeomID other, dReal*) {
    const GeomData& data = data_of(self);
    if (!data.client || data.empty || other == self)
        return 0;
    if (dGeomIsSpace(other)) {
        dSpaceCollide2(self, other, nullptr, &ignore_pair);
        return 0;
    }
    if (dGeomGetClass(other) == dRayClass)
        return 1;
    data.client->on_pair(other);
    return 0;
}

int collide_with_ray(dGeomID self, dGeomID ray, int flags, dContactGeom* contact, int skip) {
    SoftGeomClient* client = data_of(self).client;
    if (client)
        return client->on_ray(ray, flags, contact, skip);
    probe_heard = true;
    return 0;
}

dColliderFn* collider_with(int other_class) {
    return other_class == dRayClass ? &collide_with_ray : nullptr;
}

void forget(dGeomID geom) noexcept {
    const std::lock_guard guard(lock);
    live_geoms().erase(geom);
}

void destroyed(dGeomID geom) {
    GeomData& data = data_of(geom);
    forget(geom);
    if (data.client)
        data.client->on_destroyed();
    data.client = nullptr;
}

/// Class numbers start afresh after dCloseODE, and no getter tells. A geom of our class hears a
/// ray; one of a number that ODE has forgotten, or given to somebody else, does not.
bool is_registered() {
    if (class_number == 0)
        return false;
    probe_heard = false;
    const dGeomID probe = dCreateGeom(class_number);
    const dGeomID ray = dCreateRay(nullptr, 1);
    dContactGeom contact;
    dCollide(probe, ray, 1, &contact, sizeof contact);
    dGeomDestroy(ray);
    dGeomDestroy(probe);
    return probe_heard;
}

void register_class() {
    dGeomClass soft{};
    soft.bytes = sizeof(GeomData);
    soft.collider = &collider_with;
    soft.aabb = &compute_aabb;
    soft.aabb_test = &record_pair;
    soft.dtor = &destroyed;
    class_number = dCreateGeomClass(&soft);
}

} // namespace

dGeomID create_soft_geom(dSpaceID space, SoftGeomClient& client) {
    if (!is_registered())
        register_class();
    const dGeomID geom = dCreateGeom(class_number);
    data_of(geom) = {&client, false};
    {
        const std::lock_guard guard(lock);
        live_geoms().insert(geom);
    }
    if (space)
        dSpaceAdd(space, geom);
    return geom;
}

void destroy_soft_geom(dGeomID geom) noexcept {
    data_of(geom).client = nullptr;
    dGeomDestroy(geom);
}

void mark_moved(dGeomID geom) noexcept {
    const dReal* p = dGeomGetPosition(geom); // there is no public call but setting it again
    dGeomSetPosition(geom, p[0], p[1], p[2]);
}

SoftGeomClient* soft_geom_client(dGeomID geom) noexcept {
    const std::lock_guard guard(lock);
    return live_geoms().contains(geom) ? data_of(geom).client : nullptr;
}

bool is_soft_geom(dGeomID geom) noexcept {
    return class_number != 0 && dGeomGetClass(geom) == class_number;
}

int soft_geoms_in(dSpaceID space) noexcept {
    if (class_number == 0)
        return 0;
    const std::lock_guard guard(lock);
    return static_cast<int>(std::count_if(live_geoms().begin(), live_geoms().end(),
                                          [&](dGeomID g) { return dGeomGetSpace(g) == space; }));
}

dGeomID topmost(dGeomID geom) noexcept {
    while (const dSpaceID parent = dGeomGetSpace(geom))
        geom = reinterpret_cast<dGeomID>(parent);
    return geom;
}

bool is_flat(dSpaceID space) noexcept {
    // ODE 0.16.2 aborts a program that lists a quadtree.
    if (dGeomGetClass(reinterpret_cast<dGeomID>(space)) == dQuadTreeSpaceClass)
        return false;
    const int count = dSpaceGetNumGeoms(space);
    for (int i = 0; i < count; ++i)
        if (dGeomIsSpace(dSpaceGetGeom(space, i)))
            return false;
    return true;
}

void collide_all(dSpaceID space) noexcept { dSpaceCollide(space, nullptr, &ignore_pair); }

void collide_now(dGeomID geom) noexcept {
    if (const dGeomID top = topmost(geom); top != geom)
        collide_with(geom, top);
}

void collide_with(dGeomID geom, dGeomID other) noexcept {
    dSpaceCollide2(geom, other, nullptr, &ignore_pair);
}

void forget_soft_class() noexcept { class_number = 0; }

} // namespace ode::soft
