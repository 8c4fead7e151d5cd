#include "collide/convex_faces.h"

#include <ode/contact.h>

#include <algorithm>
#include <memory>

namespace ode::soft {
namespace {

constexpr int kMostContacts = 4096; // corners above or below the middle; further ones are not seen
constexpr double kFlat = 1e-9;      // of the hull's size: points this near a plane lie in it

Vec3 vec(const dReal* v) noexcept { return {v[0], v[1], v[2]}; }

} // namespace

std::vector<Vec3> convex_corners(dGeomID convex) {
    dReal box[6];
    dGeomGetAABB(convex, box);
    const double middle = (box[4] + box[5]) / 2;
    const Vec3 position = vec(dGeomGetPosition(convex));
    const dReal* r = dGeomGetRotation(convex);
    Mat3 rotation;
    for (int i = 0; i < 3; ++i)
        rotation.row(i) = Vec3(r[4 * i], r[4 * i + 1], r[4 * i + 2]);
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

} // namespace ode::soft
