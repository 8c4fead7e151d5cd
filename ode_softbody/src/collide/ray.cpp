#include "collide/ray.h"

#include <algorithm>

namespace ode::soft {
namespace {

struct Hit {
    double t; ///< along the ray [m]; negative: none
    Vec3 normal;
};

/// T. Moeller and B. Trumbore, Fast minimum storage ray/triangle intersection, J. Graphics Tools 2,
/// 1997, doi 10.1080/10867651.1997.10487468.
Hit intersect(const Vec3& start, const Vec3& direction, const Vec3& a, const Vec3& b,
              const Vec3& c) noexcept {
    const Vec3 e1 = b - a;
    const Vec3 e2 = c - a;
    const Vec3 h = direction.cross(e2);
    const double det = e1.dot(h);
    const Hit none{-1, Vec3::Zero()};
    if (det == 0)
        return none;
    const Vec3 s = start - a;
    const double u = s.dot(h) / det;
    if (!(u >= 0 && u <= 1))
        return none;
    const Vec3 q = s.cross(e1);
    const double v = direction.dot(q) / det;
    if (!(v >= 0 && u + v <= 1))
        return none;
    return {e2.dot(q) / det, e1.cross(e2)};
}

dContactGeom& at(dContactGeom* contact, int skip, int i) noexcept {
    return *reinterpret_cast<dContactGeom*>(reinterpret_cast<char*>(contact) + i * skip);
}

} // namespace

int collide_ray(dGeomID geom, dGeomID ray, std::span<const std::array<int, 3>> triangles,
                const NodeArray& position, int flags, dContactGeom* contact, int skip) noexcept {
    constexpr int kCountMask = 0xffff;
    const bool one = dGeomRayGetFirstContact(ray) || dGeomRayGetClosestHit(ray);
    const int wanted = one ? std::min(flags & kCountMask, 1) : flags & kCountMask;
    const bool cull = dGeomRayGetBackfaceCull(ray);
    const double length = dGeomRayGetLength(ray);
    dVector3 from;
    dVector3 along;
    dGeomRayGet(ray, from, along);
    const Vec3 start(from[0], from[1], from[2]);
    const Vec3 direction(along[0], along[1], along[2]);

    int found = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto [a, b, c] = triangles[i];
        const Hit hit =
            intersect(start, direction, position[static_cast<std::size_t>(a)],
                      position[static_cast<std::size_t>(b)], position[static_cast<std::size_t>(c)]);
        const double facing = hit.normal.dot(direction); // > 0: leaves the body
        if (!(hit.t >= 0 && hit.t <= length) || (cull && facing > 0))
            continue;
        int place = found;
        while (place > 0 && at(contact, skip, place - 1).depth > hit.t)
            --place;
        if (place >= wanted)
            continue;
        found = std::min(found + 1, wanted);
        for (int k = found - 1; k > place; --k)
            at(contact, skip, k) = at(contact, skip, k - 1);
        const Vec3 point = start + hit.t * direction;
        const Vec3 normal = (facing > 0 ? hit.normal : Vec3(-hit.normal)).normalized();
        dContactGeom& out = at(contact, skip, place);
        for (int axis = 0; axis < 3; ++axis) {
            out.pos[axis] = point[axis];
            out.normal[axis] = normal[axis];
        }
        out.depth = hit.t;
        out.g1 = geom;
        out.g2 = ray;
        out.side1 = static_cast<int>(i);
        out.side2 = -1;
    }
    return found;
}

} // namespace ode::soft
