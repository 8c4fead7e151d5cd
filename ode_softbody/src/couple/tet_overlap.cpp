#include "couple/tet_overlap.h"

#include <cmath>
#include <cstddef>

namespace ode::soft {
namespace {

// Corners of the face opposite each corner, outward.
constexpr std::array<std::array<std::size_t, 3>, 4> kFace{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

struct Plane {
    Vec3 normal; ///< outward, of any length
    double offset;
    double above(const Vec3& x) const noexcept { return normal.dot(x) - offset; }
};

Vec3 face_normal(const Tet& t, std::size_t f) noexcept {
    const auto& [i, j, k] = kFace[f];
    return (t[j] - t[i]).cross(t[k] - t[i]);
}

std::array<Plane, 4> planes_of(const Tet& t) noexcept {
    std::array<Plane, 4> p;
    for (std::size_t f = 0; f < 4; ++f) {
        p[f].normal = face_normal(t, f);
        p[f].offset = p[f].normal.dot(t[kFace[f][0]]);
    }
    return p;
}

/// A triangle cut by four planes has seven corners at most.
struct Polygon {
    std::array<Vec3, 8> corner;
    std::size_t size = 0;
    void add(const Vec3& x) noexcept { corner[size++] = x; }
};

/// Sutherland and Hodgman, CACM 17 (1974). What lies on the plane stays.
void cut(Polygon& polygon, const Plane& plane) noexcept {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size; ++i) {
        const Vec3& from = polygon.corner[i];
        const Vec3& to = polygon.corner[i + 1 == polygon.size ? 0 : i + 1];
        const double a = plane.above(from);
        const double b = plane.above(to);
        if (a <= 0)
            kept.add(from);
        if ((a < 0 && b > 0) || (a > 0 && b < 0))
            kept.add(from + (a / (a - b)) * (to - from));
    }
    polygon = kept;
}

bool lies_on(const Polygon& polygon, const Plane& plane) noexcept {
    for (std::size_t i = 0; i < polygon.size; ++i)
        if (plane.above(polygon.corner[i]) != 0)
            return false;
    return true;
}

struct Region {
    Vec3 area = Vec3::Zero(); ///< vector
    Vec3 center = Vec3::Zero();
};

Region region_of(const Polygon& p) noexcept {
    Region r;
    double weight = 0;
    for (std::size_t i = 1; i + 1 < p.size; ++i)
        r.area += (p.corner[i] - p.corner[0]).cross(p.corner[i + 1] - p.corner[0]) / 2;
    const double size = r.area.norm();
    if (!(size > 0))
        return {};
    for (std::size_t i = 1; i + 1 < p.size; ++i) {
        const Vec3 part = (p.corner[i] - p.corner[0]).cross(p.corner[i + 1] - p.corner[0]) / 2;
        const double w = part.dot(r.area) / size;
        r.center += w / 3 * (p.corner[i] + p.corner[i + 1] - 2 * p.corner[0]);
        weight += w;
    }
    r.center = p.corner[0] + r.center / weight;
    return r;
}

/// Adds what one tetrahedron's faces bound of the polyhedron. @param origin  near it.
void add_faces(const Tet& of, const std::array<Plane, 4>& other, const Vec3& origin, double& volume,
               Vec3& moment, Tet& gradient) noexcept {
    for (std::size_t f = 0; f < 4; ++f) {
        Polygon polygon;
        for (const std::size_t i : kFace[f])
            polygon.add(of[i]);
        const Vec3 n = face_normal(of, f);
        double share = 1;
        for (std::size_t k = 0; k < 4 && polygon.size != 0; ++k) {
            if (lies_on(polygon, other[k])) // two faces in one plane bound it half each, or nothing
                share = n.dot(other[k].normal) > 0 ? share / 2 : 0;
            else
                cut(polygon, other[k]);
        }
        if (polygon.size < 3)
            continue;
        Region r = region_of(polygon);
        r.area *= share;
        // The pyramid from the origin to the region, by the divergence theorem.
        const double pyramid = r.area.dot(r.center - origin) / 3;
        volume += pyramid;
        moment += 0.75 * pyramid * (r.center - origin);
        const double n2 = n.squaredNorm();
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3& j = of[kFace[f][(i + 1) % 3]];
            const Vec3& k = of[kFace[f][(i + 2) % 3]];
            const double weight = (j - r.center).cross(k - r.center).dot(n) / n2;
            gradient[kFace[f][i]] += weight * r.area;
        }
    }
}

bool some_face_of(const std::array<Plane, 4>& plane, const Tet& other) noexcept {
    for (const Plane& p : plane)
        if (p.above(other[0]) >= 0 && p.above(other[1]) >= 0 && p.above(other[2]) >= 0 &&
            p.above(other[3]) >= 0)
            return true;
    return false;
}

double gap_before(const std::array<Plane, 4>& plane, const Tet& other) noexcept {
    double most = -HUGE_VAL;
    for (const Plane& p : plane) {
        const double least = std::fmin(std::fmin(p.above(other[0]), p.above(other[1])),
                                       std::fmin(p.above(other[2]), p.above(other[3])));
        most = std::fmax(most, least / p.normal.norm());
    }
    return most;
}

} // namespace

double face_gap(const Tet& a, const Tet& b) noexcept {
    return std::fmax(gap_before(planes_of(a), b), gap_before(planes_of(b), a));
}

bool overlap_of(const Tet& a, const Tet& b, TetOverlap& out) noexcept {
    const auto of_a = planes_of(a);
    const auto of_b = planes_of(b);
    if (some_face_of(of_a, b) || some_face_of(of_b, a))
        return false;
    double volume = 0;
    Vec3 moment = Vec3::Zero();
    std::array<Tet, 2> gradient;
    for (Tet& g : gradient)
        g.fill(Vec3::Zero());
    const Vec3 origin = (a[0] + a[1] + a[2] + a[3] + b[0] + b[1] + b[2] + b[3]) / 8;
    add_faces(a, of_b, origin, volume, moment, gradient[0]);
    add_faces(b, of_a, origin, volume, moment, gradient[1]);
    if (!(volume > 0))
        return false;
    out = {volume, origin + moment / volume, gradient};
    return true;
}

} // namespace ode::soft
