#pragma once

#include "base/types.h"

namespace ode::soft {

/// Point of a triangle closest to another point.
struct TrianglePoint {
    Vec3 point;
    Vec3 weight; ///< barycentric: point = sum of weight_i corner_i
};

/// By Voronoi regions: C. Ericson, Real-Time Collision Detection, Morgan Kaufmann 2005, 5.1.5.
/// Weights that a region fixes at zero are exactly zero, so that they name the feature.
inline TrianglePoint closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b,
                                         const Vec3& c) noexcept {
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    const double d1 = ab.dot(p - a);
    const double d2 = ac.dot(p - a);
    if (d1 <= 0 && d2 <= 0)
        return {a, {1, 0, 0}};
    const double d3 = ab.dot(p - b);
    const double d4 = ac.dot(p - b);
    if (d3 >= 0 && d4 <= d3)
        return {b, {0, 1, 0}};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) {
        const double t = d1 / (d1 - d3);
        return {a + t * ab, {1 - t, t, 0}};
    }
    const double d5 = ab.dot(p - c);
    const double d6 = ac.dot(p - c);
    if (d6 >= 0 && d5 <= d6)
        return {c, {0, 0, 1}};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) {
        const double t = d2 / (d2 - d6);
        return {a + t * ac, {1 - t, 0, t}};
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {b + t * (c - b), {0, 1 - t, t}};
    }
    const double v = vb / (va + vb + vc);
    const double w = vc / (va + vb + vc);
    return {a + v * ab + w * ac, {1 - v - w, v, w}};
}

} // namespace ode::soft
