// What an application may get wrong about a rigid body that is to sound: a sentence each.
#include "support/rigid_ring.h"

#include <gtest/gtest.h>

#include <cstdarg>
#include <cstdio>
#include <string>

namespace {

using namespace ode;
using test::RigidRing;

std::string& said() {
    static std::string all;
    return all;
}
void note(int, const char* text, va_list arguments) {
    char line[1000];
    std::vsnprintf(line, sizeof line, text, arguments);
    said() += line;
    said() += '\n';
}

/// Messages while it lives.
struct Listening {
    Listening() {
        said().clear();
        dSetMessageHandler(note);
    }
    ~Listening() { dSetMessageHandler(nullptr); }
};

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
    const Listening listening;
    const soft::MeshHandle twice = bar(2);
    EXPECT_EQ(dSoundModalCreate(body, twice, &steel), nullptr);
    EXPECT_NE(said().find("the mesh is larger than the body: 0.4 m along x, its geoms 0.2 m"),
              std::string::npos)
        << said();
}

TEST(RigidInput, ACentreOfMassThatIsOff) {
    RigidRing app;
    const dBodyID body = box_body(app, 0.2, 0.03, 0.02);
    dGeomSetOffsetPosition(dBodyGetFirstGeom(body), 0.1, 0, 0);
    const dSoftSolid steel = RigidRing::metal();
    const soft::MeshHandle mesh = bar();
    const Listening listening;
    EXPECT_EQ(dSoundModalCreate(body, mesh, &steel), nullptr);
    EXPECT_NE(said().find("centre of mass is off"), std::string::npos) << said();
}

TEST(RigidInput, ANegativeMass) {
    RigidRing app;
    const dBodyID body = box_body(app, 0.2, 0.03, 0.02);
    dSoftSolid anti = RigidRing::metal();
    anti.density = -7850;
    const soft::MeshHandle mesh = bar();
    const Listening listening;
    EXPECT_EQ(dSoundModalCreate(body, mesh, &anti), nullptr);
    EXPECT_NE(said().find("density"), std::string::npos) << said();
}

TEST(RigidInput, AnotherMassThanTheMeshs) {
    RigidRing app;
    const dBodyID body = box_body(app, 0.2, 0.03, 0.02);
    dMass mass;
    dMassSetBoxTotal(&mass, 5, 0.2, 0.03, 0.02);
    dBodySetMass(body, &mass);
    const dSoftSolid steel = RigidRing::metal();
    const soft::MeshHandle mesh = bar();
    const Listening listening;
    EXPECT_NE(dSoundModalCreate(body, mesh, &steel), nullptr) << "it is heard, and told";
    EXPECT_NE(said().find("the body has 5 kg"), std::string::npos) << said();
}

// Two tetrahedra that share one edge: four faces meet there, and no side is out.
TEST(RigidInput, AnOpenSurface) {
    RigidRing app;
    const dBodyID body = dBodyCreate(app.world);
    const dReal node[] = {0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0};
    const int tet[] = {0, 2, 3, 1, 0, 4, 5, 1};
    const soft::MeshHandle mesh(dSoftMeshCreate(node, 6, tet, 2));
    const dSoftSolid steel = RigidRing::metal();
    const Listening listening;
    if (mesh) {
        EXPECT_EQ(dSoundModalCreate(body, mesh, &steel), nullptr);
    }
    EXPECT_NE(said().find("open"), std::string::npos) << said();
}

TEST(RigidInput, NoAudibleMode) {
    RigidRing app;
    const dBodyID ball = app.add_sphere(0.005, 7850 * 5.236e-7, 1);
    const soft::MeshHandle mesh(dSoftMeshCreateSphere(0.005, 2));
    const dSoftSolid steel = RigidRing::metal();
    const Listening listening;
    const dSoundModalID voice = dSoundModalCreate(ball, mesh, &steel);
    ASSERT_NE(voice, nullptr) << said();
    EXPECT_NE(said().find("no mode below 22 kHz"), std::string::npos) << said();
    EXPECT_EQ(dSoundModalGetModes(voice, 0, nullptr, nullptr), 0);
}

TEST(RigidInput, StrokesAndGainsThatAreNone) {
    RigidRing app;
    const RigidRing::Bar it = app.add_bar(0, 0, 0);
    const dVector3 at = {0, 0, 0}, up = {0, 0, 1}, none = {0, 0, dReal(NAN)};
    const Listening listening;
    EXPECT_EQ(dSoundModalStrike(it.voice, at, none, 1e-4), 0);
    EXPECT_EQ(dSoundModalStrike(it.voice, at, up, 0), 0);
    EXPECT_EQ(dSoundModalSetGain(it.voice, -1), 0);
    const soft::MeshHandle mesh = bar();
    const dSoftSolid steel = RigidRing::metal();
    EXPECT_EQ(dSoundModalCreate(it.body, mesh, &steel), nullptr);
    EXPECT_NE(said().find("has a voice already"), std::string::npos) << said();
}

} // namespace
