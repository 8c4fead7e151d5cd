#include "collide/shape_fault.h"

#include "base/error.h"

#include <ode/collision.h>
#include <ode/objects.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace ode::soft {
namespace {

bool finite(const dReal* values, int count) noexcept {
    return std::all_of(values, values + count, [](dReal v) { return std::isfinite(v); });
}

/// Sizes that must be finite and above 0; the others are zero-filled behind `count`.
struct Sizes {
    std::array<dReal, 3> value{};
    int count = 0;
};

Sizes sizes_of(dGeomID geom) noexcept {
    Sizes s;
    dReal length = 0;
    dVector3 sides;
    switch (dGeomGetClass(geom)) {
    case dSphereClass:
        s = {{dGeomSphereGetRadius(geom)}, 1};
        break;
    case dBoxClass:
        dGeomBoxGetLengths(geom, sides);
        s = {{sides[0], sides[1], sides[2]}, 3};
        break;
    case dCapsuleClass: // of length 0 it is a sphere
        dGeomCapsuleGetParams(geom, &s.value[0], &length);
        s.count = std::isfinite(length) ? 1 : 2;
        s.value[1] = length;
        break;
    case dCylinderClass:
        dGeomCylinderGetParams(geom, &s.value[0], &s.value[1]);
        s.count = 2;
        break;
    default:
        break;
    }
    return s;
}

bool sizes_are_sound(const Sizes& s) noexcept {
    return std::all_of(s.value.begin(), s.value.begin() + s.count,
                       [](dReal v) { return v > 0 && std::isfinite(v); });
}

bool plane_is_sound(dGeomID geom) noexcept {
    if (dGeomGetClass(geom) != dPlaneClass)
        return true;
    dVector4 plane;
    dGeomPlaneGetParams(geom, plane);
    return finite(plane, 4);
}

bool pose_is_sound(dGeomID geom) noexcept {
    return dGeomGetClass(geom) == dPlaneClass ||
           (finite(dGeomGetPosition(geom), 3) && finite(dGeomGetRotation(geom), 12));
}

bool motion_is_sound(dGeomID geom) noexcept {
    const dBodyID body = dGeomGetBody(geom);
    return !body || (finite(dBodyGetPosition(body), 3) && finite(dBodyGetQuaternion(body), 4) &&
                     finite(dBodyGetLinearVel(body), 3) && finite(dBodyGetAngularVel(body), 3));
}

} // namespace

bool shape_is_sound(dGeomID geom) noexcept {
    return sizes_are_sound(sizes_of(geom)) && plane_is_sound(geom) && pose_is_sound(geom) &&
           motion_is_sound(geom);
}

std::string shape_fault(dGeomID geom) {
    if (const Sizes s = sizes_of(geom); !sizes_are_sound(s)) {
        std::string sizes;
        for (int i = 0; i < s.count; ++i)
            sizes += format(i == 0 ? "%g" : ", %g", s.value[static_cast<std::size_t>(i)]);
        return "has the size " + sizes + " m; give it finite sizes above 0";
    }
    if (!plane_is_sound(geom))
        return "has parameters that are not finite; set them anew";
    if (!pose_is_sound(geom)) {
        const dReal* p = dGeomGetPosition(geom);
        return format("is at (%g, %g, %g) or turned by something that is not finite; set its "
                      "position and rotation anew",
                      p[0], p[1], p[2]);
    }
    if (!motion_is_sound(geom)) {
        const dReal* v = dBodyGetLinearVel(dGeomGetBody(geom));
        return format("has a body of velocity (%g, %g, %g) m/s or a spin that is not finite; set "
                      "its velocities anew",
                      v[0], v[1], v[2]);
    }
    return {};
}

std::string geom_name(dGeomID geom) {
    static constexpr std::array kName{"sphere",    "box",         "capsule", "cylinder",
                                      "plane",     "ray",         "convex",  "geom transform",
                                      "triangles", "height field"};
    const auto kind = static_cast<std::size_t>(dGeomGetClass(geom));
    return format("%s %p", kind < kName.size() ? kName[kind] : "geom", static_cast<void*>(geom));
}

} // namespace ode::soft
