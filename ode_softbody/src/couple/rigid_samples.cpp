#include "couple/rigid_samples.h"

#include <algorithm>
#include <cmath>

namespace ode::soft {
namespace {

constexpr int kMostOnALine = 48;

/// Intervals of a line.
int intervals(double length, double spacing) noexcept {
    return static_cast<int>(std::clamp(std::ceil(length / spacing), 1.0, double{kMostOnALine}));
}

void add_line(const Vec3& from, const Vec3& to, double spacing, std::vector<RigidSample>& out) {
    const int n = intervals((to - from).norm(), spacing);
    for (int i = 1; i < n; ++i)
        out.push_back({from + (to - from) * i / n, 0});
}

void add_box(const Vec3& half, double spacing, std::vector<RigidSample>& out) {
    for (int corner = 0; corner < 8; ++corner)
        out.push_back(
            {half.cwiseProduct(Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1)),
             0});
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 4; ++side) {
            Vec3 end = half;
            end[(axis + 1) % 3] *= side & 1 ? 1 : -1;
            end[(axis + 2) % 3] *= side & 2 ? 1 : -1;
            Vec3 start = end;
            start[axis] = -start[axis];
            add_line(start, end, spacing, out);
        }
}

/// Edges lie in two faces.
void add_edges(std::span<const Vec3> corner, std::span<const TangentPlane> face, double spacing,
               std::vector<RigidSample>& out) {
    for (std::size_t i = 0; i < corner.size(); ++i)
        for (std::size_t k = i + 1; k < corner.size(); ++k) {
            const double length = (corner[k] - corner[i]).norm();
            const auto holds_both = [&](const TangentPlane& f) {
                return std::fabs(f.normal.dot(corner[i]) - f.offset) < 1e-5 * length &&
                       std::fabs(f.normal.dot(corner[k]) - f.offset) < 1e-5 * length;
            };
            if (std::count_if(face.begin(), face.end(), holds_both) > 1)
                add_line(corner[i], corner[k], spacing, out);
        }
}

void add_rims(double radius, double half_length, double spacing, std::vector<RigidSample>& out) {
    const int n = std::max(12, intervals(2 * M_PI * radius, spacing));
    for (const double z : {-half_length, half_length})
        for (int i = 0; i < n; ++i) {
            const double angle = 2 * M_PI * i / n;
            out.push_back({Vec3(radius * std::cos(angle), radius * std::sin(angle), z), 0});
        }
}

} // namespace

std::vector<RigidSample> sample_shape(const RigidShape& shape, double spacing) {
    std::vector<RigidSample> out;
    const double radius = shape.size.x();
    const Vec3 end(0, 0, shape.size.z());
    switch (shape.kind) {
    case ShapeKind::sphere:
        out.push_back({Vec3::Zero(), radius});
        break;
    case ShapeKind::capsule: {
        // Between balls half a radius apart the surface dips by 3 % of the radius.
        const int n = intervals(2 * end.z(), radius / 2);
        for (int i = 0; i <= n; ++i)
            out.push_back({end * (2.0 * i / n - 1), radius});
        break;
    }
    case ShapeKind::box:
        add_box(shape.size, spacing, out);
        break;
    case ShapeKind::cylinder:
        add_rims(radius, end.z(), spacing, out);
        break;
    case ShapeKind::convex:
        for (const Vec3& corner : shape.corners)
            out.push_back({corner, 0});
        add_edges(shape.corners, shape.faces, spacing, out);
        break;
    case ShapeKind::plane:
    case ShapeKind::probed:
        break;
    }
    return out;
}

} // namespace ode::soft
