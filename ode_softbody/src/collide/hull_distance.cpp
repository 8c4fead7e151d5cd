#include "collide/shape_distance.h"

#include <Eigen/LU>

#include <array>
#include <cmath>

namespace ode::soft {
namespace {

constexpr std::size_t kMost = 12; ///< planes tried
/// A plane that meets another in a sharp edge may bound the closest point though p is within it: by
/// so many times its distance from the other.
constexpr double kSharp = 3;
constexpr double kFlat = 1e-6; ///< determinant of normals that all but lie in a plane, or on a line

/// The foot of p on the planes together, p - sum of a_i n_i, a_i >= 0, is the closest point of the
/// hull if it lies within all planes (Karush, Kuhn and Tucker).
bool is_closest(std::span<const TangentPlane> faces, const Vec3& p, const Vec3& step,
                SurfaceDistance& out) noexcept {
    const Vec3 foot = p - step;
    const double slack = 1e-9 * (step.norm() + foot.norm());
    for (const TangentPlane& face : faces)
        if (face.normal.dot(foot) - face.offset > slack)
            return false;
    const double length = step.norm();
    out = {length, step / length};
    return true;
}

} // namespace

SurfaceDistance distance_to_hull(std::span<const TangentPlane> faces, const Vec3& p,
                                 const SurfaceDistance& largest) noexcept {
    SurfaceDistance out = largest;
    if (is_closest(faces, p, largest.distance * largest.normal, out))
        return largest;
    std::array<Vec3, kMost> normal;
    std::array<double, kMost> beyond{};
    std::size_t count = 0;
    for (const TangentPlane& face : faces) {
        const double distance = face.normal.dot(p) - face.offset;
        if (distance <= -kSharp * largest.distance || count == kMost)
            continue;
        normal[count] = face.normal;
        beyond[count++] = distance;
    }
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const double c = normal[i].dot(normal[j]);
            const double scale = 1 - c * c;
            const double a = beyond[i] - c * beyond[j];
            const double b = beyond[j] - c * beyond[i];
            if (scale > kFlat && a >= 0 && b >= 0 &&
                is_closest(faces, p, (a * normal[i] + b * normal[j]) / scale, out))
                return out;
        }
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < i; ++j)
            for (std::size_t k = 0; k < j; ++k) {
                Mat3 n;
                n << normal[i], normal[j], normal[k];
                const Mat3 products = n.transpose() * n;
                if (products.determinant() < kFlat)
                    continue;
                const Vec3 a = products.inverse() * Vec3(beyond[i], beyond[j], beyond[k]);
                if (a.minCoeff() >= 0 && is_closest(faces, p, n * a, out))
                    return out;
            }
    return largest; // at a corner of more planes: too short, of the right sign
}

} // namespace ode::soft
