#include "couple/surface_probe.h"

#include <gtest/gtest.h>
#include <ode/ode.h>

#include <array>
#include <cmath>

namespace ode::soft {
namespace {

/// A unit cube as a trimesh and as a convex geom.
constexpr dReal kCorner[] = {-.5, -.5, -.5, .5, -.5, -.5, -.5, .5, -.5, .5, .5, -.5,
                             -.5, -.5, .5,  .5, -.5, .5,  -.5, .5, .5,  .5, .5, .5};
constexpr dTriIndex kTriangle[] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                   2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
constexpr dReal kFacePlane[] = {1, 0,  0, .5, -1, 0, 0, .5, 0, 1, 0,  .5,
                                0, -1, 0, .5, 0,  0, 1, .5, 0, 0, -1, .5};
constexpr unsigned kPolygon[] = {4, 1, 3, 7, 5, 4, 0, 4, 6, 2, 4, 2, 6, 7, 3,
                                 4, 0, 1, 5, 4, 4, 4, 5, 7, 6, 4, 0, 2, 3, 1};

class Probe : public testing::Test {
protected:
    Probe() { dInitODE2(0); }
    ~Probe() override { dCloseODE(); }

    /// Least plane distance over what is felt at a point of the geom's frame.
    static double distance(const SurfaceProbe& probe, dGeomID geom, const Vec3& p, Vec3* normal) {
        std::array<TangentPlane, SurfaceProbe::kMostPlanes> plane;
        const int n = probe.feel(geom, p, plane);
        if (n == 0)
            return INFINITY;
        *normal = plane[0].normal;
        return plane[0].normal.dot(p) - plane[0].offset;
    }

    static void expect_cube(dGeomID geom) {
        dQuaternion q;
        dQFromAxisAndAngle(q, 1, 2, 3, 0.8);
        dGeomSetQuaternion(geom, q);
        dGeomSetPosition(geom, 0.3, -0.2, 1.1);
        const SurfaceProbe probe(0.1);
        Vec3 normal = Vec3::Zero();
        EXPECT_NEAR(distance(probe, geom, {0.05, 0.13, 0.56}, &normal), 0.06, 1e-9);
        EXPECT_LT((normal - Vec3::UnitZ()).norm(), 1e-9);
        EXPECT_NEAR(distance(probe, geom, {-0.52, 0.11, 0.2}, &normal), 0.02, 1e-9);
        EXPECT_LT((normal + Vec3::UnitX()).norm(), 1e-9);
        EXPECT_EQ(distance(probe, geom, {0.05, 0.13, 0.7}, &normal), INFINITY);
    }
};

TEST_F(Probe, FeelsATrimesh) {
    const dTriMeshDataID data = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(data, kCorner, 3 * sizeof(dReal), 8, kTriangle, 36,
                                3 * sizeof(dTriIndex));
    const dGeomID mesh = dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr);
    expect_cube(mesh);
    dGeomDestroy(mesh);
    dGeomTriMeshDataDestroy(data);
}

TEST_F(Probe, ReadsCornersAndFacesOfAConvex) {
    const dGeomID convex = dCreateConvex(nullptr, kFacePlane, 6, kCorner, 8, kPolygon);
    dQuaternion q;
    dQFromAxisAndAngle(q, 1, 2, 3, 0.8);
    dGeomSetQuaternion(convex, q);
    dGeomSetPosition(convex, 0.3, -0.2, 1.1);
    const auto corners = convex_corners(convex);
    EXPECT_EQ(corners.size(), 8u);
    for (const Vec3& corner : corners)
        EXPECT_LT((corner.cwiseAbs() - Vec3::Constant(0.5)).norm(), 1e-14);
    const auto faces = hull_faces(corners);
    ASSERT_EQ(faces.size(), 6u);
    for (const TangentPlane& face : faces) {
        EXPECT_NEAR(face.normal.cwiseAbs().maxCoeff(), 1, 1e-14);
        EXPECT_NEAR(face.offset, 0.5, 1e-14);
    }
    dGeomDestroy(convex);
}

dReal valley(void*, int x, int) {
    return std::fabs(x - 5.0) * 0.2; // two slopes of 0.2 in 1
}

TEST_F(Probe, FeelsBothSidesOfAValleyInAHeightfield) {
    const dHeightfieldDataID data = dGeomHeightfieldDataCreate();
    dGeomHeightfieldDataBuildCallback(data, nullptr, &valley, 10, 10, 11, 11, 1, 0, 0.5, 0);
    dGeomHeightfieldDataSetBounds(data, 0, 2);
    const dGeomID field = dCreateHeightfield(nullptr, data, 1); // y up, centred
    const SurfaceProbe probe(0.1);
    std::array<TangentPlane, SurfaceProbe::kMostPlanes> plane;
    ASSERT_EQ(probe.feel(field, {0, 0.05, 0.3}, plane), 2);
    const Vec3 slope = Vec3(1, 5, 0).normalized();
    for (const TangentPlane& p : {plane[0], plane[1]}) {
        EXPECT_NEAR(std::fabs(p.normal.x()), slope.x(), 1e-6);
        EXPECT_NEAR(p.normal.y(), slope.y(), 1e-6);
        EXPECT_NEAR(p.offset, 0, 1e-6); // both pass through the bottom of the valley
    }
    dGeomDestroy(field);
    dGeomHeightfieldDataDestroy(data);
}

} // namespace
} // namespace ode::soft
