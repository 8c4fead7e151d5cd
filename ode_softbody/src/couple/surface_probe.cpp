#include "couple/surface_probe.h"

#include <ode/contact.h>

#include <algorithm>
#include <cmath>

namespace ode::soft {
namespace {

constexpr int kMostContacts = 16;
constexpr double kSameDirection = 0.999; // planes within 2.5 degrees are one

Vec3 vec(const dReal* v) noexcept { return {v[0], v[1], v[2]}; }

/// ODE's colliders put the contact either on the ball (deepest point, normal of the surface) or on
/// the surface (closest point; the normal may then be that of a face whose edge is closest), and
/// for convex geoms somewhere between (libccd), where only normal and depth mean anything.
TangentPlane plane_of(const dContactGeom& contact, const Vec3& center, double radius) noexcept {
    Vec3 normal = vec(contact.normal); // into the ball, which is g1: away from the surface
    const Vec3 at = vec(contact.pos);
    const Vec3 away = center - at;
    const double distance = away.norm();
    if (std::fabs(distance - radius) < 1e-6 * radius)
        return {normal, normal.dot(center) - (radius - contact.depth)};
    if (distance > 1e-6 * radius && away.dot(normal) > 0)
        normal = away / distance;
    return {normal, normal.dot(at)};
}

} // namespace

SurfaceProbe::SurfaceProbe(double radius)
    : ball_(dCreateSphere(nullptr, radius)), radius_(radius) {}

SurfaceProbe::~SurfaceProbe() { dGeomDestroy(ball_); }

int SurfaceProbe::feel(dGeomID geom, const Vec3& point,
                       std::array<TangentPlane, kMostPlanes>& out) const noexcept {
    const Vec3 position = vec(dGeomGetPosition(geom));
    Mat3 rotation;
    const dReal* r = dGeomGetRotation(geom);
    for (int i = 0; i < 3; ++i)
        rotation.row(i) = Vec3(r[4 * i], r[4 * i + 1], r[4 * i + 2]);
    const Vec3 center = position + rotation * point;
    dReal box[6];
    dGeomGetAABB(geom, box);
    for (int axis = 0; axis < 3; ++axis)
        if (!(center[axis] > box[2 * axis] - radius_ && center[axis] < box[2 * axis + 1] + radius_))
            return 0;
    dGeomSetPosition(ball_, center.x(), center.y(), center.z());
    dContactGeom contact[kMostContacts];
    const int n = dCollide(ball_, geom, kMostContacts, contact, sizeof contact[0]);
    std::sort(contact, contact + n,
              [](const dContactGeom& a, const dContactGeom& b) { return a.depth > b.depth; });
    int found = 0;
    for (int i = 0; i < n && found < kMostPlanes; ++i) {
        TangentPlane plane = plane_of(contact[i], center, radius_);
        plane.offset -= plane.normal.dot(position);
        plane.normal = rotation.transpose() * plane.normal;
        const bool known = std::any_of(out.begin(), out.begin() + found, [&](const auto& p) {
            return p.normal.dot(plane.normal) > kSameDirection;
        });
        if (!known && plane.normal.allFinite())
            out[static_cast<std::size_t>(found++)] = plane;
    }
    return found;
}

} // namespace ode::soft
