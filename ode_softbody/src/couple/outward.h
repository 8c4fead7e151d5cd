#pragma once

#include "collide/closest_point.h"
#include "couple/surface_nodes.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {

inline Vec3 area_vector(const SurfaceNodes& surface, const NodeArray& x, int triangle) noexcept {
    const auto& t = surface.triangle[static_cast<std::size_t>(triangle)];
    const Vec3 a = x[static_cast<std::size_t>(t[0])];
    const Vec3 b = x[static_cast<std::size_t>(t[1])];
    const Vec3 c = x[static_cast<std::size_t>(t[2])];
    return (b - a).cross(c - a);
}

/// Outward pseudonormal of the feature (face, edge or vertex) that holds a triangle's point: its
/// sign against (p - point) tells inside from outside for the closest point, where a face's own
/// normal fails at edges and vertices. J. A. Baerentzen and H. Aanaes, Signed distance computation
/// using the angle weighted pseudonormal, IEEE TVCG 11, 2005, doi 10.1109/TVCG.2005.49. Not
/// normalised.
inline Vec3 pseudonormal(const SurfaceNodes& surface, const NodeArray& x, int triangle,
                         const Vec3& weight) noexcept {
    const auto& corner = surface.triangle[static_cast<std::size_t>(triangle)];
    const auto zeros = (weight.array() == 0).count();
    if (zeros == 0)
        return area_vector(surface, x, triangle);
    Vec3 sum = Vec3::Zero();
    if (zeros == 1) { // the edge whose two corners have weight: both its faces
        int ends[2];
        int n = 0;
        for (int i = 0; i < 3; ++i)
            if (weight[i] != 0)
                ends[n++] = corner[static_cast<std::size_t>(i)];
        for (const int t : surface.fan(ends[0])) {
            const auto& c = surface.triangle[static_cast<std::size_t>(t)];
            if (std::find(c.begin(), c.end(), ends[1]) != c.end())
                sum += area_vector(surface, x, t).normalized();
        }
        return sum;
    }
    int vertex = corner[0];
    for (int i = 1; i < 3; ++i)
        if (weight[i] != 0)
            vertex = corner[static_cast<std::size_t>(i)];
    for (const int t : surface.fan(vertex)) {
        const auto& c = surface.triangle[static_cast<std::size_t>(t)];
        const auto at = static_cast<std::size_t>(std::find(c.begin(), c.end(), vertex) - c.begin());
        const Vec3 here = x[static_cast<std::size_t>(vertex)];
        const Vec3 e1 = x[static_cast<std::size_t>(c[(at + 1) % 3])] - here;
        const Vec3 e2 = x[static_cast<std::size_t>(c[(at + 2) % 3])] - here;
        const Vec3 normal = e1.cross(e2);
        sum += std::atan2(normal.norm(), e1.dot(e2)) * normal.normalized();
    }
    return sum;
}

} // namespace ode::soft
