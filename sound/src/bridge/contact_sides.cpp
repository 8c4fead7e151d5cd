#include "bridge/contact_sides.h"

#include "bridge/rigid_bodies.h"

#include <cmath>

namespace ode::sound {
namespace {

/// A stone floor: what a body touches that nobody has told of.
constexpr Elastic kStone{30e9, 0.2};

} // namespace

Geoms::Geoms() : default_elastic_(kStone) {
    default_skin_.roughness = std::make_shared<const Roughness>(Texture{});
}

void Geoms::set_elastic(dGeomID geom, const Elastic& elastic) {
    if (geom)
        elastic_[geom] = elastic;
    else
        default_elastic_ = elastic;
}

void Geoms::set_skin(dGeomID geom, const Skin& skin) {
    if (geom)
        skin_[geom] = skin;
    else
        default_skin_ = skin;
}

const Elastic& Geoms::elastic(dGeomID geom) const noexcept {
    const auto told = elastic_.find(geom);
    return told != elastic_.end() ? told->second : default_elastic_;
}

const Skin& Geoms::skin(dGeomID geom) const noexcept {
    const auto told = skin_.find(geom);
    return told != skin_.end() ? told->second : default_skin_;
}

double curvature_of(dGeomID geom) noexcept {
    if (!geom)
        return 0.0;
    dReal radius = 0.0, length = 0.0;
    switch (dGeomGetClass(geom)) {
    case dSphereClass:
        return 1.0 / dGeomSphereGetRadius(geom);
    case dCapsuleClass:
        dGeomCapsuleGetParams(geom, &radius, &length);
        return 0.5 / radius;
    case dCylinderClass:
        dGeomCylinderGetParams(geom, &radius, &length);
        return 0.5 / radius;
    default:
        return 0.0;
    }
}

double rolling_curvature(dGeomID geom, const Vec3& normal) noexcept {
    if (!geom)
        return 0.0;
    const int kind = dGeomGetClass(geom);
    if (kind == dSphereClass)
        return 1.0 / dGeomSphereGetRadius(geom);
    if (kind != dCapsuleClass && kind != dCylinderClass)
        return 0.0;
    dReal radius = 0.0, length = 0.0;
    (kind == dCapsuleClass ? dGeomCapsuleGetParams : dGeomCylinderGetParams)(geom, &radius,
                                                                             &length);
    const dReal* r = dGeomGetRotation(geom);
    const double lies = normal.dot(Vec3(r[2], r[6], r[10]));
    constexpr double kOnItsEnd = 0.7;
    return kind == dCylinderClass && std::fabs(lies) > kOnItsEnd ? 0.0 : 1.0 / radius;
}

ContactPatch patch_of(const RigidTouch& touch, RigidBody* const side[2], const Geoms& geoms) {
    ContactPatch out{};
    Elastic elastic[2];
    double reach = 0.0;
    for (int i = 0; i < 2; ++i) {
        if (side[i]) {
            const StruckSurface& surface = side[i]->model->surface;
            const RigidMotion& motion = touch.motion[i];
            out.place[i] =
                side[i]->spots.find(surface, motion.place_in_frame(touch.position),
                                    motion.into_frame(i == 0 ? Vec3(-touch.normal) : touch.normal));
            elastic[i] = side[i]->model->elastic;
            out.curvature += surface.curvature(out.place[i]);
            reach = std::max(reach, surface.radius());
        } else {
            elastic[i] = geoms.elastic(touch.geom[i]);
            out.curvature += curvature_of(touch.geom[i]);
        }
        out.loss += 0.5 * geoms.skin(touch.geom[i]).loss;
    }
    // Faces that lie flat on one another bulge by something: as a ball ten times their size.
    out.curvature = std::max(out.curvature, 0.1 / reach);
    out.modulus = contact_modulus(elastic[0], elastic[1]);
    return out;
}

namespace {

/// Whether friction stays below its limit, mu times the load, or mu itself where the joint hasn't
/// dContactApprox1: what is left of velocity then is the solver's.
bool holds(const RigidTouch& touch, double load) noexcept {
    if (!(touch.friction > 0.0)) // none, or nobody knows
        return false;
    const double normal = touch.impulse.dot(touch.normal);
    const double sideways = (touch.impulse - normal * touch.normal).norm() / normal * load;
    constexpr double kNearly = 0.9;
    return sideways < kNearly * touch.friction * std::min(load, 1.0);
}

} // namespace

Vec3 force_per_load(const RigidTouch& touch) noexcept {
    constexpr double kSteepest = 1.0;
    const double normal = touch.impulse.dot(touch.normal);
    const Vec3 across = touch.impulse - normal * touch.normal;
    const double size = across.norm();
    if (!(size > 0.0))
        return touch.normal;
    return touch.normal + across * (std::min(kSteepest, size / std::max(normal, 0.0)) / size);
}

Travel travel_of(const RigidTouch& touch, double load) noexcept {
    const RigidMotion &a = touch.motion[0], &b = touch.motion[1];
    const Vec3& n = touch.normal;
    Vec3 slip = a.velocity_at(touch.position) - b.velocity_at(touch.position);
    slip -= slip.dot(n) * n;
    if (holds(touch, load))
        slip.setZero();
    const double curved[2] = {rolling_curvature(touch.geom[0], n),
                              rolling_curvature(touch.geom[1], n)};
    const double both = curved[0] + curved[1];
    if (!(both > 0.0)) // what lies flat stays on the same place of its own surface
        return {{Vec3::Zero(), slip}};
    const Vec3 roll = (a.spin - b.spin).cross(n);
    return {{(roll - curved[1] * slip) / both, (roll + curved[0] * slip) / both}};
}

} // namespace ode::sound
