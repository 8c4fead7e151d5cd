// Every named integrator in an ODE program.
#include "support/ode_app.h"

#include <ode_softbody/softbody.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

namespace {

using namespace ode::soft;
using ode::test::OdeApp;

constexpr dReal kStep = 1.0 / 240; // [s]

struct IntegratorApp : OdeApp {
    IntegratorApp() : OdeApp(-9.81), soft(dSoftWorldCreate(world, space)) {
        heard().clear();
        dSetMessageHandler(hear);
        dSoftSolid solid = dSoftSolidDefault();
        solid.young = 1e6;
        solid.poisson = 0.3;
        solid.density = 1000;
        solid.alpha = solid.beta = 0;
        MeshHandle mesh(dSoftMeshCreateBox(0.1, 0.1, 0.1, 3, 3, 3));
        cube = dSoftBodyCreate(soft, mesh, &solid);
    }
    ~IntegratorApp() { dSetMessageHandler(nullptr); }

    dSoftStatus status() const {
        dSoftStatus out = {};
        out.struct_size = sizeof out;
        dSoftBodyGetStatus(cube, &out);
        return out;
    }

    static std::string& heard() {
        static std::string text;
        return text;
    }
    static void hear(int, const char* text, va_list arguments) {
        char line[512];
        std::vsnprintf(line, sizeof line, text, arguments);
        heard() += line;
    }

    WorldHandle soft;
    dSoftBodyID cube;
};

TEST(Integrators, AllLetABodyFall) {
    for (int i = 0; const char* name = dSoftIntegratorName(i); ++i) {
        IntegratorApp app;
        ASSERT_TRUE(dSoftBodySetIntegrator(app.cube, name)) << name;
        EXPECT_STREQ(dSoftBodyGetIntegrator(app.cube), name);
        dSoftIntegratorInfo info = {};
        info.struct_size = sizeof info;
        ASSERT_TRUE(dSoftIntegratorGetInfo(name, &info));
        if (info.implicit) {
            ASSERT_TRUE(dSoftBodySetSubstep(app.cube, 5e-4));
        }
        for (int n = 0; n < 12; ++n)
            app.step(kStep);
        dVector3 center;
        dSoftBodyGetCenterOfMass(app.cube, center);
        // First-order methods are off by g t h / 2, h at most 6e-4 s.
        EXPECT_NEAR(center[2], -9.81 * 0.05 * 0.05 / 2, 9.81 * 0.05 * 3e-4) << name;
        EXPECT_FALSE(app.status().stopped) << name;
    }
}

TEST(Integrators, AreChosenByNameBeforeTheFirstStep) {
    IntegratorApp app;
    EXPECT_STREQ(dSoftBodyGetIntegrator(app.cube), dSoftIntegratorName(0));
    EXPECT_TRUE(dSoftBodySetIntegrator(app.cube, "verlet"));
    EXPECT_STREQ(dSoftBodyGetIntegrator(app.cube), "central-difference");
    EXPECT_FALSE(dSoftBodySetIntegrator(app.cube, "leapfrgo"));
    EXPECT_NE(app.heard().find("tr-bdf2"), std::string::npos) << app.heard();
    // An implicit method takes any substep, an explicit one its critical one.
    EXPECT_FALSE(dSoftBodySetSubstep(app.cube, 1e-3));
    EXPECT_TRUE(dSoftBodySetIntegrator(app.cube, "trapezoidal"));
    EXPECT_EQ(dSoftBodyGetCriticalStep(app.cube), dInfinity);
    EXPECT_TRUE(dSoftBodySetSubstep(app.cube, 1e-3));
    EXPECT_FALSE(dSoftBodySetSubstep(app.cube, dInfinity));
    app.step(kStep);
    EXPECT_FALSE(dSoftBodySetIntegrator(app.cube, "midpoint"));
}

// L: on its own Euler's method spirals out. The body is stopped and reported, the world goes on.
TEST(Integrators, AnUnstableOneIsStoppedAndReported) {
    IntegratorApp app;
    ASSERT_TRUE(dSoftBodySetIntegrator(app.cube, "explicit-euler"));
    EXPECT_NE(app.heard().find("explicit-euler lets undamped vibrations grow"), std::string::npos);
    EXPECT_EQ(dSoftBodyGetCriticalStep(app.cube), 0);
    const dBodyID ball = app.add_sphere(0.1, 1, 5);
    dSoftBodyAddForceAtNode(app.cube, 0, 0, 0, 20);
    for (int n = 0; n < 240 && !app.status().stopped; ++n)
        app.step(kStep);
    EXPECT_TRUE(app.status().stopped);
    EXPECT_NE(app.heard().find("unstable"), std::string::npos) << app.heard();
    const dReal before = dBodyGetPosition(ball)[2];
    app.step(kStep);
    EXPECT_LT(dBodyGetPosition(ball)[2], before);
    EXPECT_TRUE(std::isfinite(dBodyGetPosition(ball)[2]));
}

} // namespace
