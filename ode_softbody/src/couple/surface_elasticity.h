#pragma once

#include "couple/contact_law.h"
#include "couple/hertz_spring.h"
#include "couple/surface_nodes.h"
#include "model/elastic_model.h"
#include "model/solid.h"

#include <span>

namespace ode::soft {

/// Finds what a point contact meets at each surface node, at rest. Takes the time of one assembly
/// of the stiffness.
///
/// Compliance: on a half-space whose far field is Boussinesq's (K. L. Johnson, Contact Mechanics,
/// 1985, 3.2), the node and its neighbours are set free and loaded; 1 % from ever larger patches on
/// flat faces.
/// @param solids  one a group of the mesh, or one for all of it.
PointElasticity measure_elasticity(const TetMesh& mesh, const SurfaceNodes& surface,
                                   const ElasticModel& model, std::span<const Solid> solids);

/// Whether contacts at points are Hertz's: not where the application has chosen a stiffness.
inline bool bears_by_point(const SurfaceNodes& surface, const ContactLaw& law) noexcept {
    return surface.elastic.known() && law.stiffness == 0;
}

/// Displacement of one corner of a triangle under a unit load on another, for the side opposite
/// each corner: as points of a half-space at that distance displace each other [m/N].
std::array<double, 3> corner_coupling(const SurfaceNodes& surface, int triangle) noexcept;

/// Spring of a point contact on a triangle, of a surface whose elasticity is known.
/// @param weight            barycentric
/// @param curvature         of the rigid side, 0: flat [1/m]
/// @param rigid_compliance  ContactLaw's [1/Pa]
HertzSpring point_spring(const SurfaceNodes& surface, int triangle, const Vec3& weight,
                         double curvature, double rigid_compliance) noexcept;

} // namespace ode::soft
