#include "collide/convex_faces.h"
#include "collide/rigid_shape.h"

#include <gmock/gmock.h>
#include <ode/ode.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

namespace ode::soft {
namespace {

RigidShape shape_of(ShapeKind kind, const Vec3& size) {
    RigidShape shape;
    shape.kind = kind;
    shape.size = size;
    return shape;
}

/// Closed membership, from the shapes' definitions and not from distances.
bool inside(const RigidShape& shape, const Vec3& p, double slack) {
    const Vec3& s = shape.size;
    switch (shape.kind) {
    case ShapeKind::plane:
        return p.z() <= slack;
    case ShapeKind::sphere:
        return p.norm() <= s.x() + slack;
    case ShapeKind::box:
        return (p.cwiseAbs() - s).maxCoeff() <= slack;
    case ShapeKind::capsule:
        return (std::fabs(p.z()) <= s.z() && p.head<2>().norm() <= s.x() + slack) ||
               (p - Vec3(0, 0, s.z())).norm() <= s.x() + slack ||
               (p + Vec3(0, 0, s.z())).norm() <= s.x() + slack;
    case ShapeKind::cylinder:
        return p.head<2>().norm() <= s.x() + slack && std::fabs(p.z()) <= s.z() + slack;
    case ShapeKind::convex:
        return std::all_of(shape.faces.begin(), shape.faces.end(), [&](const TangentPlane& face) {
            return face.normal.dot(p) - face.offset <= slack;
        });
    case ShapeKind::probed:
        break;
    }
    return false;
}

/// A skew wedge: its edges meet at sharp and blunt angles.
RigidShape wedge() {
    static const std::vector<TangentPlane> faces = hull_faces(std::vector<Vec3>{{-1, -1.2, -0.4},
                                                                                {1.3, -0.9, -0.5},
                                                                                {1.1, 1, -0.6},
                                                                                {-0.8, 0.9, -0.3},
                                                                                {0.2, -0.7, 1.1},
                                                                                {0.1, 0.8, 0.9}});
    RigidShape shape;
    shape.kind = ShapeKind::convex;
    shape.faces = faces;
    return shape;
}

class RigidShapeDistance : public testing::TestWithParam<RigidShape> {
protected:
    Vec3 random_point() {
        std::uniform_real_distribution<double> coordinate(-3, 3);
        return {coordinate(random_), coordinate(random_), coordinate(random_)};
    }
    std::mt19937 random_{7};
};

// d is the distance if p - d n is on the surface and nothing of the other side is nearer than |d|:
// the ball round p, a little smaller than |d|, lies wholly on p's side.
TEST_P(RigidShapeDistance, IsTheRadiusOfTheLargestBallOnOneSide) {
    const RigidShape& shape = GetParam();
    for (int i = 0; i < 500; ++i) {
        const Vec3 p = random_point();
        const auto [d, n] = shape.distance(p);
        ASSERT_NEAR(n.norm(), 1, 1e-14);
        ASSERT_EQ(d <= 0, inside(shape, p, 0)) << p.transpose();
        const Vec3 foot = p - d * n;
        ASSERT_TRUE(inside(shape, foot, 1e-12)) << p.transpose(); // rounding of lengths up to 5
        ASSERT_FALSE(inside(shape, foot, -1e-12)) << p.transpose();
        for (int k = 0; k < 50; ++k) {
            const Vec3 q = p + 0.999999 * std::fabs(d) * random_point().normalized();
            ASSERT_EQ(inside(shape, q, 0), d <= 0) << p.transpose();
        }
    }
}

TEST_P(RigidShapeDistance, NormalIsTheGradient) {
    const RigidShape& shape = GetParam();
    constexpr double h =
        1e-6; // error of the central difference: 1e-12 of curvature, 1e-10 rounding
    for (int i = 0; i < 500; ++i) {
        const Vec3 p = random_point();
        const auto [d, n] = shape.distance(p);
        Vec3 slope;
        for (int axis = 0; axis < 3; ++axis) {
            const Vec3 step = h * Vec3::Unit(axis);
            slope[axis] =
                (shape.distance(p + step).distance - shape.distance(p - step).distance) / (2 * h);
        }
        if (std::fabs(slope.norm() - 1) < 1e-6) { // off the medial surface, where it jumps
            ASSERT_LT((slope - n).norm(), 1e-6) << p.transpose();
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, RigidShapeDistance,
                         testing::Values(shape_of(ShapeKind::plane, {0, 0, 0}),
                                         shape_of(ShapeKind::sphere, {1.2, 0, 0}),
                                         shape_of(ShapeKind::box, {0.5, 1.5, 0.9}),
                                         shape_of(ShapeKind::capsule, {0.6, 0, 1.1}),
                                         shape_of(ShapeKind::cylinder, {0.8, 0, 1.3}), wedge()));

TEST(RigidShapeDistance, IsDefinedOnCentresEdgesAndCorners) {
    for (const RigidShape& shape :
         {shape_of(ShapeKind::sphere, {1, 0, 0}), shape_of(ShapeKind::box, {1, 1, 1}),
          shape_of(ShapeKind::capsule, {1, 0, 1}), shape_of(ShapeKind::cylinder, {1, 0, 1})})
        for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(1, 0, 1), Vec3(0, 0, -1)}) {
            const auto [d, n] = shape.distance(p);
            EXPECT_TRUE(std::isfinite(d));
            EXPECT_NEAR(n.norm(), 1, 1e-14);
        }
}

// dGeomBoxPointDepth says 1.01 deep for a point 0.01 outside a unit box (ODE 0.16.2).
TEST(RigidShapeDistance, OfABoxIsRightOutside) {
    EXPECT_NEAR(shape_of(ShapeKind::box, {0.5, 0.5, 0.5}).distance({0.51, 0, 0}).distance, 0.01,
                1e-15);
}

class CapturedShape : public testing::Test {
protected:
    static void SetUpTestSuite() { dInitODE2(0); }
    static void TearDownTestSuite() { dCloseODE(); }

    CapturedShape() : world_(dWorldCreate()), body_(dBodyCreate(world_)) {
        dQuaternion q;
        dQFromAxisAndAngle(q, 1, 2, 3, 0.8);
        dBodySetQuaternion(body_, q);
        dBodySetPosition(body_, 0.3, -0.2, 1.1);
    }
    ~CapturedShape() override { dWorldDestroy(world_); }

    Pose body_pose() const {
        Pose pose;
        const dReal* x = dBodyGetPosition(body_);
        const dReal* r = dBodyGetRotation(body_);
        for (int i = 0; i < 3; ++i) {
            pose.position[i] = x[i];
            for (int j = 0; j < 3; ++j)
                pose.rotation(i, j) = r[4 * i + j];
        }
        return pose;
    }

    dWorldID world_;
    dBodyID body_;
};

using GeomPtr = std::unique_ptr<dxGeom, decltype(&dGeomDestroy)>;

TEST_F(CapturedShape, AgreesWithPointDepthsOfOde) {
    const GeomPtr sphere(dCreateSphere(nullptr, 0.4), &dGeomDestroy);
    const GeomPtr capsule(dCreateCapsule(nullptr, 0.2, 0.9), &dGeomDestroy);
    const GeomPtr plane(dCreatePlane(nullptr, 1, 2, 2, 0.7), &dGeomDestroy);
    for (const dGeomID geom : {sphere.get(), capsule.get()}) {
        dGeomSetBody(geom, body_);
        dGeomSetOffsetPosition(geom, 0.1, 0.2, -0.3);
        dQuaternion q;
        dQFromAxisAndAngle(q, -1, 1, 0.5, 1.3);
        dGeomSetOffsetQuaternion(geom, q);
    }
    std::mt19937 random(3);
    std::uniform_real_distribution<double> coordinate(-2, 2);
    for (int i = 0; i < 200; ++i) {
        const Vec3 p(coordinate(random), coordinate(random), coordinate(random));
        const auto distance = [&](const GeomPtr& geom) {
            return capture_shape(geom.get())->distance_at(body_pose(), p).distance;
        };
        EXPECT_NEAR(distance(sphere), -dGeomSpherePointDepth(sphere.get(), p.x(), p.y(), p.z()),
                    1e-14);
        EXPECT_NEAR(distance(capsule), -dGeomCapsulePointDepth(capsule.get(), p.x(), p.y(), p.z()),
                    1e-14);
        const auto from_plane = capture_shape(plane.get())->distance_at(Pose{}, p);
        EXPECT_NEAR(from_plane.distance, -dGeomPlanePointDepth(plane.get(), p.x(), p.y(), p.z()),
                    1e-14);
        EXPECT_LT((from_plane.normal - Vec3(1, 2, 2) / 3).norm(), 1e-15);
    }
}

// The centre of the shape, where ODE puts it, and the six face centres are at known distances.
TEST_F(CapturedShape, FollowsOffsetsAndTransforms) {
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
    const GeomPtr transform(dCreateGeomTransform(nullptr), &dGeomDestroy);
    const dGeomID box = dCreateBox(nullptr, 0.2, 0.4, 0.6);
    dGeomSetPosition(box, 0.5, 0, 0);
    dGeomTransformSetCleanup(transform.get(), 1);
    dGeomTransformSetGeom(transform.get(), box);
    dGeomSetBody(transform.get(), body_);
#pragma GCC diagnostic pop
    const auto shape = capture_shape(transform.get());
    ASSERT_TRUE(shape);
    EXPECT_EQ(shape->kind, ShapeKind::box);
    EXPECT_EQ(shape->body, body_);
    const Vec3 centre = body_pose().to_world({0.5, 0, 0});
    EXPECT_NEAR(shape->distance_at(body_pose(), centre).distance, -0.1, 1e-15);
    const Vec3 above = body_pose().to_world({0.5, 0, 0.4});
    EXPECT_NEAR(shape->distance_at(body_pose(), above).distance, 0.1, 1e-15);
    EXPECT_LT((shape->distance_at(body_pose(), above).normal - body_pose().rotation.col(2)).norm(),
              1e-15);
}

TEST_F(CapturedShape, BoundsHoldTheShape) {
    const GeomPtr cylinder(dCreateCylinder(nullptr, 0.3, 1.0), &dGeomDestroy);
    dGeomSetBody(cylinder.get(), body_);
    const Aabb box = capture_shape(cylinder.get())->bounds(body_pose());
    dReal odes[6];
    dGeomGetAABB(cylinder.get(), odes);
    for (int axis = 0; axis < 3; ++axis) { // ODE's is tighter for round shapes, never larger
        EXPECT_LE(box.low[axis], odes[2 * axis] + 1e-15);
        EXPECT_GE(box.high[axis], odes[2 * axis + 1] - 1e-15);
    }
}

TEST_F(CapturedShape, RefusesWhatItCannotEvaluate) {
    const GeomPtr ray(dCreateRay(nullptr, 1), &dGeomDestroy);
    EXPECT_FALSE(capture_shape(ray.get()));
    const GeomPtr sphere(dCreateSphere(nullptr, 0.4), &dGeomDestroy);
    dGeomSetPosition(sphere.get(), std::nan(""), 0, 0);
    EXPECT_FALSE(capture_shape(sphere.get()));
}

} // namespace
} // namespace ode::soft
