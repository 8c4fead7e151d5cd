// What an application may get wrong about a rigid body that is to sound: a sentence each.
#include "support/rigid_ring.h"
#include "support/soft_app.h"

#include <gtest/gtest.h>

#include <cstdarg>
#include <cstdio>
#include <string>

namespace {

using namespace ode;
using test::Messages;
using test::RigidRing;

dBodyID box_body(RigidRing& app, dReal x, dReal y, dReal z) {
    dMass mass;
    dMassSetBox(&mass, 7850, x, y, z);
    const dBodyID body = dBodyCreate(app.world);
    dBodySetMass(body, &mass);
    dGeomSetBody(dCreateBox(app.space, x, y, z), body);
    return body;
}

soft::MeshHandle bar(dReal scale = 1) {
    return soft::MeshHandle(dSoftMeshCreateBox(0.2 * scale, 0.03 * scale, 0.02 * scale, 6, 1, 1));
}

TEST(RigidInput, AMeshLargerThanTheBody) {
    RigidRing app;
    const dBodyID body = box_body(app, 0.2, 0.03, 0.02);
    const dSoftSolid steel = RigidRing::metal();
    const Messages messages;
    const soft::MeshHandle twice = bar(2);
    EXPECT_EQ(dSoundModalCreate(body, twice, &steel), nullptr);
    EXPECT_GT(Messages::with("the mesh is larger than the body: 0.4 m along x, its geoms 0.2 m"), 0)
        << Messages::text();
}

TEST(RigidInput, ACentreOfMassThatIsOff) {
    RigidRing app;
    const dBodyID body = box_body(app, 0.2, 0.03, 0.02);
    dGeomSetOffsetPosition(dBodyGetFirstGeom(body), 0.1, 0, 0);
    const dSoftSolid steel = RigidRing::metal();
    const soft::MeshHandle mesh = bar();
    const Messages messages;
    EXPECT_EQ(dSoundModalCreate(body, mesh, &steel), nullptr);
    EXPECT_GT(Messages::with("centre of mass is off"), 0) << Messages::text();
}

TEST(RigidInput, ANegativeMass) {
    RigidRing app;
    const dBodyID body = box_body(app, 0.2, 0.03, 0.02);
    dSoftSolid anti = RigidRing::metal();
    anti.density = -7850;
    const soft::MeshHandle mesh = bar();
    const Messages messages;
    EXPECT_EQ(dSoundModalCreate(body, mesh, &anti), nullptr);
    EXPECT_GT(Messages::with("density"), 0) << Messages::text();
}

TEST(RigidInput, AnotherMassThanTheMeshs) {
    RigidRing app;
    const dBodyID body = box_body(app, 0.2, 0.03, 0.02);
    dMass mass;
    dMassSetBoxTotal(&mass, 5, 0.2, 0.03, 0.02);
    dBodySetMass(body, &mass);
    const dSoftSolid steel = RigidRing::metal();
    const soft::MeshHandle mesh = bar();
    const Messages messages;
    EXPECT_NE(dSoundModalCreate(body, mesh, &steel), nullptr) << "it is heard, and told";
    EXPECT_GT(Messages::with("the body has 5 kg"), 0) << Messages::text();
}

// Two tetrahedra that share one edge: four faces meet there, and no side is out.
TEST(RigidInput, AnOpenSurface) {
    RigidRing app;
    const dBodyID body = dBodyCreate(app.world);
    const dReal node[] = {0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0};
    const int tet[] = {0, 2, 3, 1, 0, 4, 5, 1};
    const soft::MeshHandle mesh(dSoftMeshCreate(node, 6, tet, 2));
    const dSoftSolid steel = RigidRing::metal();
    const Messages messages;
    if (mesh) {
        EXPECT_EQ(dSoundModalCreate(body, mesh, &steel), nullptr);
    }
    EXPECT_GT(Messages::with("open"), 0) << Messages::text();
}

TEST(RigidInput, NoAudibleMode) {
    RigidRing app;
    const dBodyID ball = app.add_sphere(0.005, 7850 * 5.236e-7, 1);
    const soft::MeshHandle mesh(dSoftMeshCreateSphere(0.005, 2));
    const dSoftSolid steel = RigidRing::metal();
    const Messages messages;
    const dSoundModalID voice = dSoundModalCreate(ball, mesh, &steel);
    ASSERT_NE(voice, nullptr) << Messages::text();
    EXPECT_GT(Messages::with("no mode below 22 kHz"), 0) << Messages::text();
    EXPECT_EQ(dSoundModalGetModes(voice, 0, nullptr, nullptr), 0);
}

TEST(RigidInput, StrokesAndGainsThatAreNone) {
    RigidRing app;
    const RigidRing::Bar it = app.add_bar(0, 0, 0);
    const dVector3 at = {0, 0, 0}, up = {0, 0, 1}, none = {0, 0, dReal(NAN)};
    const Messages messages;
    EXPECT_EQ(dSoundModalStrike(it.voice, at, none, 1e-4), 0);
    EXPECT_EQ(dSoundModalStrike(it.voice, at, up, 0), 0);
    EXPECT_EQ(dSoundModalSetGain(it.voice, -1), 0);
    const soft::MeshHandle mesh = bar();
    const dSoftSolid steel = RigidRing::metal();
    EXPECT_EQ(dSoundModalCreate(it.body, mesh, &steel), nullptr);
    EXPECT_GT(Messages::with("has a voice already"), 0) << Messages::text();
}

} // namespace
