#include "collide/convex_faces.h"

#include <ode/contact.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>

namespace ode::soft {
namespace {

constexpr int kMostContacts = 4096; // corners above or below the middle; further ones are not seen
constexpr double kFlat = 1e-9;      // of the hull's size: points this near a plane lie in it

constexpr double kSamePlane = 1e-6; // of vertices that may be single precision
constexpr std::size_t kMostFaces = 64;
constexpr int kMostTriangles = 1024;

Vec3 vec(const dReal* v) noexcept { return {v[0], v[1], v[2]}; }

Mat3 rotation_of(dGeomID geom) noexcept {
    const dReal* r = dGeomGetRotation(geom);
    Mat3 rotation;
    for (int i = 0; i < 3; ++i)
        rotation.row(i) = Vec3(r[4 * i], r[4 * i + 1], r[4 * i + 2]);
    return rotation;
}

/// Every side of a triangle is another's, run the other way.
bool is_closed(std::vector<std::array<std::size_t, 2>> side) {
    auto back = side;
    for (auto& s : back)
        std::swap(s[0], s[1]);
    std::sort(side.begin(), side.end());
    std::sort(back.begin(), back.end());
    return side == back && std::adjacent_find(side.begin(), side.end()) == side.end();
}

} // namespace

std::vector<Vec3> convex_corners(dGeomID convex) {
    dReal box[6];
    dGeomGetAABB(convex, box);
    const double middle = (box[4] + box[5]) / 2;
    const Vec3 position = vec(dGeomGetPosition(convex));
    const Mat3 rotation = rotation_of(convex);
    const std::unique_ptr<dxGeom, decltype(&dGeomDestroy)> plane(dCreatePlane(nullptr, 0, 0, 1, 0),
                                                                 &dGeomDestroy);
    std::vector<dContactGeom> contact(kMostContacts);
    std::vector<Vec3> corners;
    for (const int side : {1, -1}) {
        dGeomPlaneSetParams(plane.get(), 0, 0, side, side * middle);
        const int n =
            dCollide(convex, plane.get(), kMostContacts, contact.data(), sizeof(dContactGeom));
        for (int i = 0; i < n; ++i) {
            const Vec3 at =
                rotation.transpose() * (vec(contact[static_cast<std::size_t>(i)].pos) - position);
            if (std::find(corners.begin(), corners.end(), at) == corners.end())
                corners.push_back(at); // a corner in the plane is seen twice
        }
    }
    return corners;
}

std::vector<TangentPlane> hull_faces(std::span<const Vec3> corners) {
    double size = 0;
    for (const Vec3& c : corners)
        size = std::max(size, (c - corners[0]).norm());
    std::vector<TangentPlane> faces;
    const auto add = [&](const TangentPlane& face) {
        const bool known = std::any_of(faces.begin(), faces.end(), [&](const auto& f) {
            return (f.normal - face.normal).norm() < kFlat;
        });
        const bool holds_all = !known && std::all_of(corners.begin(), corners.end(), [&](auto& c) {
            return face.normal.dot(c) <= face.offset + kFlat * size;
        });
        if (holds_all)
            faces.push_back(face);
    };
    for (std::size_t i = 0; i < corners.size(); ++i)
        for (std::size_t j = i + 1; j < corners.size(); ++j)
            for (std::size_t k = j + 1; k < corners.size(); ++k) {
                const Vec3 across = (corners[j] - corners[i]).cross(corners[k] - corners[i]);
                if (across.norm() <= kFlat * size * size)
                    continue;
                const Vec3 n = across.normalized();
                add({n, n.dot(corners[i])});
                add({-n, -n.dot(corners[i])});
            }
    return faces;
}

ConvexMesh convex_mesh(dGeomID trimesh) {
    const int count = dGeomTriMeshGetTriangleCount(trimesh);
    if (count < 4 || count > kMostTriangles)
        return {};
    const Vec3 position = vec(dGeomGetPosition(trimesh));
    const Mat3 rotation = rotation_of(trimesh);
    dReal box[6];
    dGeomGetAABB(trimesh, box);
    const double size = (Vec3(box[1], box[3], box[5]) - Vec3(box[0], box[2], box[4])).norm();
    ConvexMesh out;
    std::vector<std::array<std::size_t, 2>> side;
    for (int t = 0; t < count; ++t) {
        dVector3 v[3];
        dGeomTriMeshGetTriangle(trimesh, t, &v[0], &v[1], &v[2]);
        std::array<std::size_t, 3> at{};
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 x = rotation.transpose() * (vec(v[i]) - position);
            const auto found =
                std::find_if(out.corner.begin(), out.corner.end(),
                             [&](const Vec3& c) { return (c - x).norm() < kFlat * size; });
            at[i] = static_cast<std::size_t>(found - out.corner.begin());
            if (found == out.corner.end())
                out.corner.push_back(x);
        }
        for (std::size_t i = 0; i < 3; ++i)
            side.push_back({at[i], at[(i + 1) % 3]});
        const Vec3 a = out.corner[at[0]];
        const Vec3 across = (out.corner[at[1]] - a).cross(out.corner[at[2]] - a);
        if (!(across.norm() > kFlat * size * size))
            return {};
        const Vec3 n = across.normalized();
        const auto same = [&](const TangentPlane& f) {
            return (f.normal - n).norm() < kSamePlane &&
                   std::fabs(f.offset - n.dot(a)) < kSamePlane * size;
        };
        if (std::any_of(out.face.begin(), out.face.end(), same))
            continue;
        out.face.push_back({n, n.dot(a)});
        if (out.face.size() > kMostFaces)
            return {};
    }
    const auto holds_all = [&](const TangentPlane& f) {
        return std::all_of(out.corner.begin(), out.corner.end(), [&](const Vec3& c) {
            return f.normal.dot(c) <= f.offset + kSamePlane * size;
        });
    };
    const bool convex = std::all_of(out.face.begin(), out.face.end(), holds_all);
    return convex && is_closed(std::move(side)) ? out : ConvexMesh{};
}

} // namespace ode::soft
