// Soft bodies among themselves under ODE's own step, through the public interface alone.
#include "physics/contact/soft_app.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <numeric>

namespace ode::soft {
namespace {

constexpr double kStep = 1.0 / 240;

TEST(SoftMeetsSoft, PairsFarApartCostNoTest) {
    SoftApp app;
    const MeshHandle mesh(dSoftMeshCreateBox(0.1, 0.1, 0.1, 3, 3, 3));
    app.add(mesh, SoftApp::solid(1e6, 1000), {0, 0, 0});
    app.add(mesh, SoftApp::solid(1e6, 1000), {1, 0, 0});
    for (int i = 0; i < 10; ++i)
        app.step(kStep);
    EXPECT_EQ(app.stats().soft_pairs, 0u); // their geoms' boxes never met
    EXPECT_EQ(app.stats().soft_looks, 0u);
    EXPECT_EQ(app.stats().soft_tests, 0u);
}

TEST(SoftMeetsSoft, MomentumThroughOdesStep) {
    SoftApp app;
    const MeshHandle mesh(dSoftMeshCreateBox(0.1, 0.1, 0.1, 3, 3, 3));
    app.add(mesh, SoftApp::solid(1e6, 1000), {-0.07, 0.01, 0.02}, {1, 0, 0}, 0.5);
    const dSoftBodyID b = app.add(mesh, SoftApp::solid(1e6, 300), {0.07, 0, 0}, {-1, 0, 0}, 0.5);
    const Vec3 linear = app.momentum();
    const Vec3 angular = app.angular_momentum();
    for (int i = 0; i < 24; ++i)
        app.step(kStep);
    EXPECT_GT(SoftApp::velocity(b).x(), 0);
    EXPECT_LT((app.momentum() - linear).norm(), 1e-13);
    EXPECT_LT((app.angular_momentum() - angular).norm(), 1e-14);
}

TEST(SoftMeetsSoft, VolumePenaltyThroughOdesStep) {
    SoftApp app;
    EXPECT_STREQ(dSoftWorldGetSoftContactMethod(app.soft), "closest-point");
    EXPECT_EQ(dSoftWorldSetSoftContactMethod(app.soft, "volumes"), 0);
    ASSERT_EQ(dSoftWorldSetSoftContactMethod(app.soft, "volume"), 1);
    EXPECT_STREQ(dSoftWorldGetSoftContactMethod(app.soft), "volume");
    const MeshHandle mesh(dSoftMeshCreateBox(0.1, 0.1, 0.1, 3, 3, 3));
    app.add(mesh, SoftApp::solid(1e6, 1000), {-0.07, 0.01, 0.02}, {1, 0, 0}, 0.5);
    const dSoftBodyID b = app.add(mesh, SoftApp::solid(1e6, 300), {0.07, 0, 0}, {-1, 0, 0}, 0.5);
    const Vec3 linear = app.momentum();
    const Vec3 angular = app.angular_momentum();
    for (int i = 0; i < 24; ++i)
        app.step(kStep);
    EXPECT_GT(SoftApp::velocity(b).x(), 0);
    EXPECT_LT((app.momentum() - linear).norm(), 1e-13);
    EXPECT_LT((app.angular_momentum() - angular).norm(), 1e-14);
}

// Three blocks of rubber, each dropped on the one below, with the damping of the material alone.
TEST(SoftMeetsSoft, AStackOfThreeComesToRest) {
    SoftApp app(9.81);
    dCreatePlane(app.space, 0, 0, 1, 0);
    // Low ones: a tower of cubes sways for long, which stiffness-proportional damping hardly sees.
    const MeshHandle mesh(dSoftMeshCreateBox(0.2, 0.2, 0.1, 4, 4, 2));
    for (int i = 0; i < 3; ++i) {
        const dSoftBodyID b =
            app.add(mesh, SoftApp::solid(2e5, 1000, 0.3, 1e-3),
                    {0.002 * i, -0.001 * i, 0.051 + 0.102 * i}, Vec3::Zero(), 0.5);
        dSoftContact contact = dSoftContactDefault();
        dSoftBodySetContact(b, &contact);
    }
    for (int i = 0; i < 1200; ++i)
        app.step(kStep);
    double buzz = 0; // fastest node over a quarter of a second
    std::vector<double> height;
    for (int i = 0; i < 60; ++i) {
        app.step(kStep);
        for (const dSoftBodyID b : app.body) {
            const dReal* v = nullptr;
            int stride = 0;
            const int n = dSoftBodyGetVelocities(b, &v, &stride);
            for (int k = 0; k < n; ++k)
                buzz = std::fmax(buzz, Eigen::Map<const Vec3>(v + k * stride).norm());
        }
    }
    for (const dSoftBodyID b : app.body)
        height.push_back(SoftApp::center(b).z());
    std::printf("centres at %.2f %.2f %.2f mm; fastest node %.1e m/s\n", 1e3 * height[0],
                1e3 * height[1], 1e3 * height[2], buzz);
    EXPECT_FALSE(app.any_stopped());
    // The lowest cube carries 2.5 of its weights on average over its height, the others 1.5 and
    // 0.5: rho g L^2 / E = 0.49 mm each time; the contacts give about as much again.
    EXPECT_NEAR(height[0], 0.050, 0.0025);
    EXPECT_NEAR(height[1], 0.150, 0.005);
    EXPECT_NEAR(height[2], 0.250, 0.007);
    EXPECT_LT(buzz, 0.01); // it still sways: e in 0.3 s
}

/// A strip along x, bent over by its pinned right half being carried to the left above the left.
struct Folded {
    double least; ///< gap between the strip's halves where they lie on each other [m]
    dSoftWorldStats stats;
    bool stopped;
};

Folded fold(bool self_contact, const char* method = "closest-point") {
    SoftApp app;
    dSoftWorldSetSoftContactMethod(app.soft, method);
    const double length = 0.2;
    const double thick = 0.004;
    const MeshHandle mesh(dSoftMeshCreatePlate(length, 0.04, thick, 20, 4, 1));
    const dSoftSolid solid = SoftApp::solid(2e4, 1000, 0.3, 2e-3);
    const dSoftBodyID sheet = app.add(mesh, solid, Vec3::Zero());
    dSoftBodySetMaterialModel(sheet, "stable-neo-hookean");
    dSoftBodySetSelfContact(sheet, self_contact);
    // Gentle forces close the strip: its right end is pulled up and over, then pressed down.
    const std::vector<Vec3> rest = SoftApp::positions(sheet);
    std::vector<int> left;
    std::vector<int> right;
    for (std::size_t i = 0; i < rest.size(); ++i) {
        if (rest[i].x() < -0.45 * length)
            left.push_back(static_cast<int>(i));
        if (rest[i].x() > 0.45 * length)
            right.push_back(static_cast<int>(i));
    }
    // Left half clamped, right end drawn to a point 6 mm *below* the left end: through it.
    std::vector<int> clamped;
    for (std::size_t i = 0; i < rest.size(); ++i)
        if (rest[i].x() < -0.1 * length)
            clamped.push_back(static_cast<int>(i));
    dSoftBodyPinNodes(sheet, clamped.data(), static_cast<int>(clamped.size()));
    for (int i = 0; i < 360; ++i) {
        const std::vector<Vec3> x = SoftApp::positions(sheet);
        Vec3 end = Vec3::Zero();
        for (const int n : right)
            end += x[static_cast<std::size_t>(n)] / static_cast<double>(right.size());
        const double phase = std::fmin(1.0, i / 240.0) * M_PI; // along a half circle
        const Vec3 goal(0.45 * length * std::cos(phase), 0,
                        0.08 * std::sin(phase) - 0.02 * std::fmax(0, i - 240) / 120.0);
        const Vec3 pull = 8.0 * (goal - end) / static_cast<double>(right.size());
        for (const int n : right)
            dSoftBodyAddForceAtNode(sheet, n, pull.x(), pull.y(), pull.z());
        app.step(kStep);
    }
    const std::vector<Vec3> x = SoftApp::positions(sheet);
    double end = 0;
    for (const int n : right)
        end += x[static_cast<std::size_t>(n)].z() / static_cast<double>(right.size());
    std::printf("self contact %d: right end %.2f mm above the left's middle\n", self_contact,
                1e3 * end);
    return {end, app.stats(), app.any_stopped()};
}

TEST(SelfContact, AFoldedSheetDoesNotPassThroughItself) {
    const Folded without = fold(false);
    EXPECT_LT(without.least, -0.002) << "the forces must suffice to draw it through";
    const Folded with = fold(true);
    EXPECT_FALSE(with.stopped);
    // Thickness 4 mm; the end may press in by a part of it.
    EXPECT_GT(with.least, 0.003);
    EXPECT_GT(with.stats.soft_tests, 0u);
}

TEST(SelfContact, TheVolumePenaltyKeepsItOutToo) {
    const Folded with = fold(true, "volume");
    EXPECT_FALSE(with.stopped);
    EXPECT_GT(with.least, 0.002); // softer at first: force grows with the square of depth
    EXPECT_GT(with.stats.soft_tests, 0u);
}

TEST(SelfContact, CostsNoTestWhileTheBodyKeepsItsShape) {
    SoftApp app(9.81);
    const MeshHandle mesh(dSoftMeshCreateBox(0.1, 0.1, 0.1, 3, 3, 3));
    const dSoftBodyID cube = app.add(mesh, SoftApp::solid(1e6, 1000), Vec3::Zero());
    dSoftBodyAddAngularVel(cube, 3, 2, 1);
    dSoftBodySetSelfContact(cube, 1);
    for (int i = 0; i < 50; ++i)
        app.step(kStep);
    EXPECT_EQ(app.stats().soft_tests, 0u);
    EXPECT_LE(app.stats().soft_looks, 60u); // one a step, hardly more
}

} // namespace
} // namespace ode::soft
