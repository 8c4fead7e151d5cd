// A soft body that the application puts into a rigid one.
#include "support/ode_app.h"

#include <ode_softbody/softbody.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace {

using namespace ode::soft;
using ode::test::OdeApp;

// Shot off at 18 m/s when all of the depth pushed at once.
TEST(Overlap, IsResolvedGently) {
    OdeApp app(0);
    WorldHandle soft(dSoftWorldCreate(app.world, app.space));
    MeshHandle mesh(dSoftMeshCreateBar(0.3, 0.02, 0.02, 15, 2, 2));
    dSoftSolid solid = dSoftSolidDefault();
    solid.young = 1e7;
    solid.poisson = 0.3;
    solid.density = 1100;
    const dSoftBodyID bar = dSoftBodyCreate(soft.get(), mesh.get(), &solid);
    dSoftBodySetPosition(bar, 0, 0, 0);
    dGeomSetPosition(dCreateSphere(app.space, 0.05), 0, 0, -0.058); // 2 mm into the bar
    double fastest = 0;
    for (int i = 0; i < 120; ++i) {
        app.step(1.0 / 240);
        dVector3 p, l;
        dSoftBodyGetMomentum(bar, p, l);
        fastest = std::fmax(fastest, p[2] / dSoftBodyGetMass(bar));
    }
    dVector3 centre;
    dSoftBodyGetCenterOfMass(bar, centre);
    std::printf("up to %.4f m/s; risen by %.2f mm in 0.5 s\n", fastest, 1e3 * centre[2]);
    // Shown at 4 / s: 2 mm * 4 / s = 8 mm/s, and a few times that where it bends back.
    EXPECT_LT(fastest, 0.05);
    EXPECT_GT(centre[2], 0.5e-3);
}

} // namespace
