#include "couple/pair_law.h"

#include <cmath>

namespace ode::soft {
namespace {

// A node is pressed by its own point and by those of the other surface on its triangles, whose
// areas add up to about its own; and each spring has two ends. By Gershgorin's rows a node of mass
// m then adds 4 k dt^2 / m at most to dt^2 lambda. The normal spring is stable at any stiffness:
// friction, 0.7 of it, has to stay within kStiffnessShare: 4 * 0.7 / 3 < 1. A normal spring no
// stiffer than that would be softer than a body of few elements.
constexpr double kShare = 1.0 / 3;
constexpr double kHardness = 7; // 3 loses more energy, 10 gains some at 0.1 of the wave speed

double bearable(const SoftPartner& body) noexcept {
    return kShare * kStiffnessShare / (body.substep * body.substep);
}

} // namespace

PairLaw make_pair_law(const SoftPartner& points, const SoftPartner& faces) noexcept {
    PairLaw law;
    law.friction = std::sqrt(points.law.friction * faces.law.friction);
    if (std::isnan(law.friction)) // 0 * infinity
        law.friction = 0;
    law.hardness = kHardness;
    law.stiffness = kHardness * std::fmin(bearable(points) * points.surface.nodes().mass_per_area,
                                          bearable(faces) * faces.surface.nodes().mass_per_area);
    for (const SoftPartner* side : {&points, &faces})
        if (side->law.stiffness > 0)
            law.stiffness = std::fmin(law.stiffness, side->law.stiffness);
    law.damping = (points.law.damping + faces.law.damping) / 2;
    law.bearable_point = bearable(points);
    law.bearable_face = bearable(faces);
    law.bearable_point_damping = kShare * kDampingShare / points.substep;
    law.bearable_face_damping = kShare * kDampingShare / faces.substep;
    return law;
}

} // namespace ode::soft
