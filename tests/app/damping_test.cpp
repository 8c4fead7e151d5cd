// Damping through the public header: conversions, bodies damped by modes, T60 of modes.
#include "support/ode_app.h"

#include <ode_softbody/softbody.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdarg>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

namespace {

using namespace ode::soft;

std::string heard;
void hear(int, const char* text, va_list arguments) {
    char line[1024];
    std::vsnprintf(line, sizeof line, text, arguments);
    heard += line;
}
int no_rigid_step(dWorldID, dReal) { return 1; }

class Damping : public testing::Test {
protected:
    Damping() : app(0), soft(dSoftWorldCreate(app.world, app.space)) {
        setenv("ODE_SOFTBODY_CACHE", "", 1);
        heard.clear();
        dSetMessageHandler(hear);
    }
    ~Damping() override { dSetMessageHandler(nullptr); }
    dSoftBodyID add_bar(const dSoftSolid& solid) {
        const MeshHandle mesh(dSoftMeshCreateBar(0.1, 0.02, 0.01, 5, 1, 1));
        dSoftBodyID body = dSoftBodyCreate(soft, mesh, &solid);
        if (body)
            dSoftBodySetPosition(body, 0, ++bars, 0); // out of each other's reach
        return body;
    }
    static double energy(dSoftBodyID body) {
        const dSoftEnergy e = dSoftBodyGetEnergy(body);
        return e.kinetic + e.elastic;
    }

    ode::test::OdeApp app;
    WorldHandle soft;
    int bars = 0;
};

TEST_F(Damping, ConversionsAgreeWithEachOther) {
    const double f = 523, d = 3;
    EXPECT_NEAR(dSoftT60FromDecay(d), 6.907755 / d, 1e-6);
    EXPECT_NEAR(dSoftQFromDecay(d, f), std::numbers::pi * f / d, 1e-9);
    EXPECT_NEAR(dSoftLossFactorFromDecay(d, f), 1 / dSoftQFromDecay(d, f), 1e-15);
    EXPECT_NEAR(dSoftDecayFromT60(dSoftT60FromDecay(d)), d, 1e-14);
    EXPECT_NEAR(dSoftDecayFromQ(dSoftQFromDecay(d, f), f), d, 1e-14);
    EXPECT_NEAR(dSoftDecayFromLossFactor(dSoftLossFactorFromDecay(d, f), f), d, 1e-14);

    dSoftSolid solid = dSoftSolidDefault();
    ASSERT_EQ(dSoftSolidSetT60(&solid, 200, 2, 4000, 0.3), 1);
    EXPECT_NEAR(dSoftT60FromDecay(dSoftDecayFromSolid(&solid, 200)), 2, 1e-12);
    EXPECT_NEAR(dSoftT60FromDecay(dSoftDecayFromSolid(&solid, 4000)), 0.3, 1e-12);
    solid.loss_factor = 0.01;
    EXPECT_NEAR(dSoftDecayFromSolid(&solid, 200),
                dSoftDecayFromT60(2) + dSoftDecayFromLossFactor(0.01, 200), 1e-12);
    EXPECT_EQ(dSoftSolidSetT60(&solid, 200, 1, 4000, 2), 0);
    EXPECT_NE(heard.find("must not grow with frequency"), std::string::npos) << heard;
}

// The substep of a viscous body is shorter; by modes it is that of an undamped one.
TEST_F(Damping, ByModesCostsNothingOfTheSubstep) {
    dSoftSolid solid = dSoftSolidDefault();
    solid.beta = 3e-7;
    dSoftSolid undamped = solid;
    undamped.alpha = undamped.beta = 0;
    dSoftBodyID by_stress = add_bar(solid), by_modes = add_bar(solid), none = add_bar(undamped);
    EXPECT_EQ(dSoftBodyGetModalDamping(by_modes), 0);
    ASSERT_EQ(dSoftBodySetModalDamping(by_modes, 1), 1);
    EXPECT_EQ(dSoftBodyGetModalDamping(by_modes), 1);
    EXPECT_NEAR(dSoftBodyGetSubstep(by_modes) / dSoftBodyGetSubstep(none), 1, 1e-9);
    EXPECT_LT(dSoftBodyGetSubstep(by_stress), 0.9 * dSoftBodyGetSubstep(none));
    ASSERT_EQ(dSoftBodySetModalDamping(by_modes, 0), 1);
    EXPECT_NEAR(dSoftBodyGetSubstep(by_modes) / dSoftBodyGetSubstep(by_stress), 1, 1e-9);
}

TEST_F(Damping, LossFactorAndTableTurnModesOnAndTakeEnergy) {
    dSoftSolid solid = dSoftSolidDefault();
    solid.alpha = solid.beta = 0;
    dSoftSolid lossy = solid;
    lossy.loss_factor = 0.01;
    dSoftBodyID undamped = add_bar(solid), eta = add_bar(lossy), table = add_bar(solid);
    const dReal f[] = {1000, 30000}, t60[] = {0.02, 0.02};
    ASSERT_EQ(dSoftBodySetDampingTable(table, f, t60, 2), 1);
    EXPECT_EQ(dSoftBodyGetModalDamping(undamped), 0);
    for (dSoftBodyID body : {undamped, eta, table}) {
        if (body != undamped) {
            EXPECT_EQ(dSoftBodyGetModalDamping(body), 1);
        }
        dSoftBodyAddForceAtNode(body, 0, 0, 0, 0.1);
        dSoftBodyAddAngularVel(body, 0, 30, 0);
    }
    dSoftWorldStep(soft, 1e-3, no_rigid_step);
    std::vector<double> before;
    dVector3 p, l[2][3];
    int i = 0;
    for (dSoftBodyID body : {undamped, eta, table}) {
        before.push_back(energy(body));
        dSoftBodyGetMomentum(body, p, l[0][i++]);
    }
    for (int n = 0; n < 20; ++n)
        dSoftWorldStep(soft, 1e-3, no_rigid_step);
    EXPECT_NEAR(energy(undamped), before[0], 1e-3 * before[0]);
    i = 0;
    for (dSoftBodyID body : {undamped, eta, table}) {
        dSoftBodyGetMomentum(body, p, l[1][i]);
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(l[1][i][axis], l[0][i][axis], 1e-12);
        ++i;
    }
    EXPECT_LT(energy(eta), before[1]);
    EXPECT_LT(energy(table), before[2]);
    EXPECT_EQ(heard, "");
}

TEST_F(Damping, RefusesNonsenseWithASentence) {
    dSoftSolid solid = dSoftSolidDefault();
    solid.loss_factor = -1e-3;
    EXPECT_EQ(add_bar(solid), nullptr);
    EXPECT_NE(heard.find("loss factor is -0.001"), std::string::npos) << heard;
    solid.loss_factor = 1e-3;
    dSoftBodyID body = add_bar(solid);
    EXPECT_EQ(dSoftBodySetModalDamping(body, 0), 0);
    EXPECT_NE(heard.find("needs modes"), std::string::npos) << heard;
    const dReal f[] = {1000, 500}, t60[] = {1, 1}, zero[] = {1, 0};
    EXPECT_EQ(dSoftBodySetDampingTable(body, f, t60, 2), 0);
    EXPECT_NE(heard.find("500 Hz, doesn't lie above"), std::string::npos) << heard;
    EXPECT_EQ(dSoftBodySetDampingTable(body, t60, zero, 2), 0);
    EXPECT_EQ(dSoftBodySetDampingTable(body, nullptr, t60, 2), 0);
    EXPECT_EQ(dSoftBodySetDampingTable(body, f, t60, -1), 0);
    EXPECT_EQ(dSoftBodySetDampingTable(body, nullptr, nullptr, 0), 1);
    dSoftWorldStep(soft, 1e-4, no_rigid_step);
    heard.clear();
    EXPECT_EQ(dSoftBodySetDampingTable(body, f, t60, 1), 0);
    EXPECT_NE(heard.find("first step"), std::string::npos) << heard;
}

// Two pieces in one body have twelve rigid motions, which one frame can't tell apart.
TEST_F(Damping, OfABodyInPiecesIsRefusedAndItRingsOn) {
    const dReal nodes[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 5, 1, 0, 5, 0, 1, 5, 0, 0, 6};
    const int tets[] = {0, 1, 2, 3, 4, 5, 6, 7};
    const MeshHandle mesh(dSoftMeshCreate(nodes, 8, tets, 2));
    ASSERT_TRUE(mesh) << heard;
    dSoftSolid solid = dSoftSolidDefault();
    solid.loss_factor = 1e-3;
    dSoftBodyID body = dSoftBodyCreate(soft, mesh, &solid);
    ASSERT_NE(body, nullptr) << heard;
    EXPECT_EQ(dSoftWorldStep(soft, 1e-4, no_rigid_step), 1);
    EXPECT_NE(heard.find("make a body of each piece"), std::string::npos) << heard;
    heard.clear();
    EXPECT_EQ(dSoftWorldStep(soft, 1e-4, no_rigid_step), 1);
    EXPECT_EQ(heard, "") << "once is enough";
}

TEST_F(Damping, ModesTellTheirT60) {
    const MeshHandle mesh(dSoftMeshCreateBar(0.3, 0.02, 0.01, 6, 1, 1));
    dSoftSolid solid = dSoftSolidDefault();
    solid.alpha = 3;
    solid.beta = 2e-8;
    solid.loss_factor = 1e-3;
    dSoftModesOptions options = dSoftModesOptionsDefault();
    options.count = 4;
    const ModesHandle modes(dSoftModesCompute(mesh, &solid, 1, nullptr, 0, &options));
    ASSERT_TRUE(modes) << heard;
    const dReal *f = nullptr, *t60 = nullptr;
    ASSERT_EQ(dSoftModesGetFrequencies(modes, &f), 4);
    ASSERT_EQ(dSoftModesGetT60(modes, &t60), 4);
    for (int k = 0; k < 4; ++k)
        EXPECT_NEAR(t60[k], dSoftT60FromDecay(dSoftDecayFromSolid(&solid, f[k])), 1e-12 * t60[k]);
    solid.alpha = solid.beta = solid.loss_factor = 0;
    const ModesHandle undamped(dSoftModesCompute(mesh, &solid, 1, nullptr, 0, &options));
    dSoftModesGetT60(undamped, &t60);
    EXPECT_TRUE(std::isinf(t60[0]));
}

} // namespace
