// Vibration modes through the public header.
#include "scenes/plate.h"
#include "support/ode_app.h"

#include <ode_softbody/softbody.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

namespace {

using namespace ode::soft;

class Modes : public testing::Test {
protected:
    Modes() {
        setenv("ODE_SOFTBODY_CACHE", "", 1);
        options.count = 4;
        options.max_frequency = dInfinity;
        solid.young = 69e9;
        solid.poisson = 0.33;
        solid.density = 2700;
    }
    ModesHandle compute(dSoftMeshID mesh, const std::vector<int>& clamped = {}) const {
        return ModesHandle(dSoftModesCompute(mesh, &solid, 1,
                                             clamped.empty() ? nullptr : clamped.data(),
                                             static_cast<int>(clamped.size()), &options));
    }
    static std::vector<int> left_end(dSoftMeshID mesh) {
        const dReal* x = nullptr;
        const int n = dSoftMeshGetNodes(mesh, &x);
        std::vector<int> out;
        for (int i = 0; i < n; ++i)
            if (x[3 * i] < 1e-9)
                out.push_back(i);
        return out;
    }
    static dSoftModesInfo info_of(dSoftModesID modes) {
        dSoftModesInfo info{};
        info.struct_size = sizeof info;
        EXPECT_EQ(dSoftModesGetInfo(modes, &info), 1);
        return info;
    }

    ode::test::OdeApp app;
    dSoftModesOptions options = dSoftModesOptionsDefault();
    dSoftSolid solid = dSoftSolidDefault();
};

// Euler-Bernoulli, case A1: 90.70 Hz. A solid's clamp adds 7 cents, the coarse mesh up to its band.
TEST_F(Modes, ClampedBarHasItsPitchAndShape) {
    const MeshHandle mesh(dSoftMeshCreateBar(0.3, 0.02, 0.01, 12, 2, 1));
    const ModesHandle modes = compute(mesh, left_end(mesh));
    ASSERT_TRUE(modes);
    const dReal *f = nullptr, *band = nullptr;
    ASSERT_EQ(dSoftModesGetFrequencies(modes, &f), 4);
    ASSERT_EQ(dSoftModesGetErrorCents(modes, &band), 4);
    const double expected = 1.87510 * 1.87510 / (2 * std::numbers::pi * 0.09) *
                            std::sqrt(69e9 / 2700 * 0.01 * 0.01 / 12);
    EXPECT_NEAR(1200 * std::log2(f[0] / expected), 7, band[0] + 1);
    EXPECT_LT(band[0], 20);
    EXPECT_LT(f[0], f[1]);

    const dReal* shape = nullptr;
    int stride = 0;
    ASSERT_EQ(dSoftModesGetShape(modes, 0, &shape, &stride), dSoftMeshGetNodes(mesh, nullptr));
    for (const int held : left_end(mesh))
        EXPECT_EQ(shape[held * stride + 2], 0);
    // A mass-normalised cantilever's tip moves by 2 / sqrt(m), whatever the mode.
    const dReal* x = nullptr;
    const int nodes = dSoftMeshGetNodes(mesh, &x);
    for (int i = 0; i < nodes; ++i)
        if (x[3 * i] > 0.3 - 1e-9) {
            EXPECT_NEAR(std::abs(shape[i * stride + 2]), 2 / std::sqrt(0.162), 0.02 * 4.97);
        }
    EXPECT_EQ(dSoftModesGetShape(modes, 4, &shape, &stride), 0);

    const dSoftModesInfo info = info_of(modes);
    EXPECT_NEAR(info.mass, 0.162, 1e-9);
    EXPECT_NEAR(info.center[0], 0.15, 1e-9);
    EXPECT_EQ(info.rigid_modes, 0);
    EXPECT_EQ(info.curved_edges, 0);
    EXPECT_EQ(info.elements, dSoftMeshGetElements(mesh, nullptr));
}

// Lamb 1882, nu = 0.33: the lowest mode of a sphere is the torsional one of degree 2, five alike,
// k_t a = 2.5011 whatever nu; the facets lose 4 % of the radius' square.
TEST_F(Modes, FacetsOfASphereAreRebuilt) {
    const MeshHandle mesh(dSoftMeshCreateSphere(0.05, 2));
    const double shear_speed = std::sqrt(69e9 / (2 * 1.33 * 2700));
    const double expected = 2.5011 * shear_speed / (2 * std::numbers::pi * 0.05);
    double error[2], volume[2];
    for (const int curved : {0, 1}) {
        options.rebuilt_curves = curved;
        const ModesHandle modes = compute(mesh);
        ASSERT_TRUE(modes);
        const dReal *f = nullptr, *band = nullptr;
        dSoftModesGetFrequencies(modes, &f);
        dSoftModesGetErrorCents(modes, &band);
        error[curved] = std::abs(1200 * std::log2(f[0] / expected));
        volume[curved] = info_of(modes).volume;
        EXPECT_EQ(info_of(modes).curved_edges > 0, curved == 1);
        EXPECT_EQ(info_of(modes).rigid_modes, 6);
        if (curved) {
            EXPECT_LE(error[1], band[0]);
        }
    }
    EXPECT_LT(error[1], 0.2 * error[0]);
    const double exact = 4.0 / 3 * std::numbers::pi * 0.05 * 0.05 * 0.05;
    EXPECT_LT(std::abs(volume[1] - exact), 0.1 * std::abs(volume[0] - exact));
    std::printf("sphere: straight %.2f, rebuilt %.2f cents\n", error[0], error[1]);
}

TEST_F(Modes, RefinementKeepsTheToleranceAndTheNodes) {
    const MeshHandle mesh(dSoftMeshCreateBar(0.3, 0.02, 0.02, 6, 1, 1));
    options.count = 2;
    const ModesHandle coarse = compute(mesh);
    ASSERT_TRUE(coarse);
    const dReal *rough = nullptr, *band = nullptr, *shape = nullptr;
    dSoftModesGetErrorCents(coarse, &rough);
    options.tolerance = 0.5 * std::max(rough[0], rough[1]);
    const ModesHandle fine = compute(mesh);
    ASSERT_TRUE(fine);
    dSoftModesGetErrorCents(fine, &band);
    EXPECT_LE(std::max(band[0], band[1]), options.tolerance);
    int stride = 0;
    EXPECT_EQ(dSoftModesGetShape(fine, 0, &shape, &stride), dSoftMeshGetNodes(mesh, nullptr));
    EXPECT_GE(info_of(fine).refinements, 1);
}

// The plate of softsound's demos, as it moves: quadratic elements, diagonal mass. Leissa (NASA
// SP-160), clamped square; shear takes 1 to 5 cents off what these elements are too stiff by.
TEST_F(Modes, DemoPlateMeetsLeissa) {
    const scenes::World world;
    dSoftSolid steel = dSoftSolidDefault();
    dSoftSolidPreset("steel", &steel);
    const MeshHandle mesh = scenes::graded_plate(40);
    const dSoftBodyID body = dSoftBodyCreate(world.soft(), mesh, &steel);
    ASSERT_TRUE(dSoftBodySetOrder(body, 2));
    const dReal* first = nullptr;
    int stride = 0;
    std::vector<int> rim;
    const int nodes = dSoftBodyGetPositions(body, &first, &stride);
    for (int i = 0; i < nodes; ++i) {
        const dReal* x = first + static_cast<std::ptrdiff_t>(i) * stride;
        if (std::fmax(std::abs(x[0]), std::abs(x[1])) > scenes::kPlateSide / 2 - 1e-9)
            rim.push_back(i);
    }
    dSoftBodyPinNodes(body, rim.data(), static_cast<int>(rim.size()));
    const double thinness = scenes::kPlateThickness / (scenes::kPlateSide * scenes::kPlateSide);
    const double bending =
        thinness / (2 * std::numbers::pi) *
        std::sqrt(steel.young / (12 * steel.density * (1 - steel.poisson * steel.poisson)));
    const double leissa[] = {35.99, 73.41, 73.41, 108.27, 131.64, 132.25, 165.15};
    dReal found[std::size(leissa)];
    ASSERT_EQ(dSoftBodyGetModes(body, std::size(leissa), found), std::ssize(leissa));
    for (std::size_t i = 0; i < std::size(leissa); ++i)
        EXPECT_NEAR(1200 * std::log2(found[i] / (leissa[i] * bending)), 0, 5) << i;
}

TEST_F(Modes, CacheIsWhereTheEnvironmentSays) {
    EXPECT_EQ(dSoftGetCacheDirectory(), nullptr); // set to nothing above
    setenv("ODE_SOFTBODY_CACHE", "/a", 1);
    EXPECT_STREQ(dSoftGetCacheDirectory(), "/a");
}

TEST_F(Modes, MistakesAndCancellingGiveNothing) {
    const MeshHandle mesh(dSoftMeshCreateBox(1, 1, 1, 2, 2, 2));
    options.progress = [](void* calls, const char*, dReal, int) {
        return ++*static_cast<int*>(calls) < 3 ? 1 : 0;
    };
    int calls = 0;
    options.progress_data = &calls;
    EXPECT_FALSE(compute(mesh));
    EXPECT_EQ(calls, 3);
    options.progress = nullptr;
    EXPECT_TRUE(compute(mesh));
    EXPECT_FALSE(compute(mesh, {1000}));
    options.count = 0; // and no highest frequency
    EXPECT_FALSE(compute(mesh));
    options = dSoftModesOptionsDefault();
    options.order = 4;
    EXPECT_FALSE(compute(mesh));
    solid.poisson = 0.5;
    options.order = 2;
    EXPECT_FALSE(compute(mesh));
    EXPECT_EQ(dSoftMeshScale(mesh, 0), 0);
    EXPECT_EQ(dSoftMeshScale(mesh, 2), 1);
    EXPECT_EQ(dSoftMeshGetGroupCount(mesh), 0);
    EXPECT_EQ(dSoftMeshGetGroupName(mesh, 0), nullptr);
    EXPECT_EQ(dSoftMeshGetOrder(mesh), 1);
}

} // namespace
