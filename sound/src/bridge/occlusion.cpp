#include "bridge/occlusion.h"

#include <ode_softbody/softbody.h>

#include <algorithm>
#include <array>
#include <limits>

namespace ode::sound {
namespace {

struct Search {
    dGeomID ray;
    dGeomID own;
    unsigned long hides;
    bool hit;
};

void meet(void* data, dGeomID a, dGeomID b) {
    auto& search = *static_cast<Search*>(data);
    if (search.hit)
        return;
    if (dGeomIsSpace(a) || dGeomIsSpace(b)) {
        dSpaceCollide2(a, b, data, &meet);
        return;
    }
    const dGeomID other = a == search.ray ? b : a;
    if (other == search.own || !(dGeomGetCategoryBits(other) & search.hides))
        return;
    dContactGeom contact;
    search.hit = dCollide(search.ray, other, 1, &contact, sizeof contact) > 0;
}

bool overlaps(const dReal* box, const dReal* low, const dReal* high) {
    for (int k = 0; k < 3; ++k)
        if (box[2 * k] > high[k] || box[2 * k + 1] < low[k])
            return false;
    return true;
}

/// A half space that the whole box lies outside of hides nothing: the floor.
bool is_clear_of(dGeomID plane, const dReal* low, const dReal* high) {
    dVector4 p;
    dGeomPlaneGetParams(plane, p);
    double least = -p[3];
    for (int k = 0; k < 3; ++k)
        least += p[k] * (p[k] > 0.0 ? low[k] : high[k]);
    return least > 0.0;
}

bool any_near(dSpaceID space, dGeomID own, unsigned long hides, const dReal* low,
              const dReal* high) {
    const int count = dSpaceGetNumGeoms(space);
    for (int i = 0; i < count; ++i) {
        const dGeomID geom = dSpaceGetGeom(space, i);
        if (geom == own || !dGeomIsEnabled(geom))
            continue;
        if (dGeomIsSpace(geom)) {
            if (any_near(reinterpret_cast<dSpaceID>(geom), own, hides, low, high))
                return true;
            continue;
        }
        if (!(dGeomGetCategoryBits(geom) & hides) || dGeomGetClass(geom) == dRayClass)
            continue;
        dReal box[6];
        dGeomGetAABB(geom, box);
        if (overlaps(box, low, high) &&
            (dGeomGetClass(geom) != dPlaneClass || !is_clear_of(geom, low, high)))
            return true;
    }
    return false;
}

dGeomID geom_of(const void* body) {
    return dSoftBodyGetGeom(static_cast<dSoftBodyID>(const_cast<void*>(body)));
}

/// For bodies whose nodes nobody looks at: the middle of its box and half way to each corner.
int points_of_box(const void* body, std::span<std::array<double, 3>> out) {
    dReal box[6];
    dGeomGetAABB(geom_of(body), box);
    for (std::size_t p = 0; p < 9; ++p)
        for (std::size_t k = 0; k < 3; ++k) {
            const double share = p == 8 ? 0.5 : (p >> k) % 2 == 0 ? 0.25 : 0.75;
            out[p][k] = box[2 * k] + share * (box[2 * k + 1] - box[2 * k]);
        }
    return 9;
}

} // namespace

void Occlusion::set(dSpaceID space, unsigned long hides) {
    if (ray_ && !space) {
        dGeomDestroy(ray_);
        ray_ = nullptr;
    }
    if (space && !ray_)
        ray_ = dCreateRay(nullptr, 1.0);
    space_ = space;
    hides_ = hides;
}

bool Occlusion::may_hide(Scene& scene, const void* body, const dReal* low,
                         const dReal* high) const {
    if (any_near(space_, geom_of(body), hides_, low, high))
        return true;
    // Soft geoms hide from those who list a space.
    bool found = false;
    scene.for_each_body([&](const void* other, BodySource&) {
        if (found || other == body || !(dGeomGetCategoryBits(geom_of(other)) & hides_))
            return;
        dReal box[6];
        dGeomGetAABB(geom_of(other), box);
        found = overlaps(box, low, high);
    });
    return found;
}

bool Occlusion::is_hidden(const void* body, const Vec3& from, const Vec3& to) {
    // Off the surface, which may lie on a floor, and short of the ear, which may lie on a head.
    constexpr double kMargin = 5e-3; // [m]
    const Vec3 way = to - from;
    const double distance = way.norm();
    if (distance < 4.0 * kMargin)
        return false;
    const Vec3 unit = way / distance;
    const Vec3 start = from + kMargin * unit;
    dGeomRaySet(ray_, start[0], start[1], start[2], unit[0], unit[1], unit[2]);
    dGeomRaySetLength(ray_, distance - 2.0 * kMargin);
    Search search{ray_, geom_of(body), hides_, false};
    dSpaceCollide2(ray_, reinterpret_cast<dGeomID>(space_), &search, &meet);
    ++rays_;
    return search.hit;
}

void Occlusion::update(Scene& scene, double duration) {
    if (!space_)
        return;
    unsigned long pairs = 0; // of bodies and listeners: each takes its turn
    scene.for_each_body([&](const void*, BodySource&) { pairs += scene.listeners(); });
    if (pairs == 0)
        return;
    const double sweep = 2.0 * Patches::kMost * static_cast<double>(pairs);
    credit_ = std::min(credit_ + kRaysPerSecond * duration, sweep);
    const unsigned long first = turn_ % pairs;
    for (unsigned long done = 0; done < pairs && credit_ >= 1.0; ++done) {
        unsigned long at = 0;
        const unsigned long mine = (first + done) % pairs;
        scene.for_each_body([&](const void* body, BodySource& source) {
            for (const auto& listener : scene.all()) {
                if (at++ != mine)
                    continue;
                std::array<std::array<double, 3>, Patches::kMost> centre{};
                const bool by_nodes = !source.is_silent();
                const Patches* patches = by_nodes ? &source.patches(centre) : nullptr;
                const int count = patches ? patches->count : points_of_box(body, centre);
                const auto ears = listener->places();
                dReal low[3], high[3];
                for (int k = 0; k < 3; ++k) {
                    low[k] = std::min(ears[0][k], ears[1][k]);
                    high[k] = std::max(ears[0][k], ears[1][k]);
                    for (int p = 0; p < count; ++p) {
                        const double x =
                            centre[static_cast<std::size_t>(p)][static_cast<std::size_t>(k)];
                        low[k] = std::min(low[k], x);
                        high[k] = std::max(high[k], x);
                    }
                }
                const bool maybe = may_hide(scene, body, low, high);
                if (!maybe && !listener->has_shade(source))
                    continue;
                Shade& shade = listener->shade(source);
                shade.set_patches(count);
                for (int e = 0; e < listener->ears(); ++e)
                    for (int p = 0; p < count; ++p) {
                        const auto& c = centre[static_cast<std::size_t>(p)];
                        const bool hidden = maybe && is_hidden(body, {c[0], c[1], c[2]},
                                                               ears[static_cast<std::size_t>(e)]);
                        shade.see(e, p, !hidden);
                        credit_ -= maybe ? 1.0 : 0.0;
                    }
            }
        });
        ++turn_;
    }
}

} // namespace ode::sound
