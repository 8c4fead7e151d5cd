// Quadratic elements, other constitutive laws and curved surfaces, through the public API.
#include "support/ode_app.h"

#include <ode_softbody/softbody.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace ode::soft;
using ode::test::OdeApp;

constexpr dReal kStep = 1.0 / 240; // [s]

dSoftSolid jelly(dReal young = 1e6) {
    dSoftSolid solid = dSoftSolidDefault();
    solid.young = young;
    solid.poisson = 0.3;
    solid.density = 1000;
    solid.alpha = 0;
    solid.beta = 0;
    return solid;
}

struct FormApp : OdeApp {
    explicit FormApp(dReal gravity_z = 0)
        : OdeApp(gravity_z), soft(dSoftWorldCreate(world, space)) {
        heard().clear();
        dSetMessageHandler(hear);
    }
    ~FormApp() { dSetMessageHandler(nullptr); }

    dSoftBodyID add_cube(dReal side, int cells) {
        MeshHandle mesh(dSoftMeshCreateBox(side, side, side, cells, cells, cells));
        const dSoftSolid solid = jelly();
        return dSoftBodyCreate(soft, mesh, &solid);
    }

    static std::string& heard() {
        static std::string text;
        return text;
    }
    static void hear(int, const char* text, va_list arguments) {
        char line[512];
        std::vsnprintf(line, sizeof line, text, arguments);
        heard() = line;
    }

    WorldHandle soft;
};

std::vector<dReal> packed(dSoftBodyID body, int (*get)(dSoftBodyID, const dReal**, int*)) {
    const dReal* first = nullptr;
    int stride = 0;
    const int count = get(body, &first, &stride);
    std::vector<dReal> out;
    for (int i = 0; i < count; ++i)
        out.insert(out.end(), first + i * stride, first + i * stride + 3);
    return out;
}

dReal height(dSoftBodyID body) {
    dVector3 center;
    dSoftBodyGetCenterOfMass(body, center);
    return center[2];
}

dSoftStatus status_of(dSoftBodyID body) {
    dSoftStatus status{};
    status.struct_size = sizeof status;
    dSoftBodyGetStatus(body, &status);
    return status;
}

TEST(BodyForm, QuadraticKeepsIndicesPlaceAndVelocityOfTheMeshsNodes) {
    FormApp app;
    dSoftBodyID cube = app.add_cube(0.1, 2);
    const dQuaternion q = {std::cos(0.3), std::sin(0.3), 0, 0};
    dSoftBodyRotate(cube, q);
    dSoftBodySetPosition(cube, 1, 2, 3);
    dSoftBodySetLinearVel(cube, 0.1, 0.2, 0.3);
    dSoftBodyAddAngularVel(cube, 4, 5, 6);
    const auto x = packed(cube, dSoftBodyGetPositions), v = packed(cube, dSoftBodyGetVelocities);
    dVector3 p1, l1, p2, l2;
    dSoftBodyGetMomentum(cube, p1, l1);
    const int* triangle = nullptr;
    const int triangles = dSoftBodyGetTriangles(cube, &triangle);

    ASSERT_EQ(dSoftBodySetOrder(cube, 2), 1);
    EXPECT_EQ(dSoftBodyGetOrder(cube), 2);
    const auto x2 = packed(cube, dSoftBodyGetPositions), v2 = packed(cube, dSoftBodyGetVelocities);
    ASSERT_GT(x2.size(), x.size());
    EXPECT_EQ(std::vector<dReal>(x2.begin(), x2.begin() + static_cast<long>(x.size())), x);
    EXPECT_EQ(std::vector<dReal>(v2.begin(), v2.begin() + static_cast<long>(v.size())), v);
    EXPECT_EQ(dSoftBodyGetTriangles(cube, &triangle), 4 * triangles);
    EXPECT_NEAR(dSoftBodyGetMass(cube), 1, 1e-12);
    dSoftBodyGetMomentum(cube, p2, l2);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(p2[axis], p1[axis], 1e-12);
        // Lumping puts mass outwards, the less the finer: 1/600 kg m^2 is exact.
        const double exact = (4 + axis) / 600.0;
        EXPECT_LT(std::abs(l2[axis] - exact), 0.5 * std::abs(l1[axis] - exact));
    }
    // Rigid motion carries no strain, and there is a way back.
    EXPECT_LT(dSoftBodyGetEnergy(cube).elastic, 1e-12);
    ASSERT_EQ(dSoftBodySetOrder(cube, 1), 1);
    EXPECT_EQ(packed(cube, dSoftBodyGetPositions), x);
    EXPECT_EQ(packed(cube, dSoftBodyGetVelocities), v);
}

class EveryForm : public testing::TestWithParam<std::tuple<int, const char*>> {};

// Undamped, unevenly shaped, on a plane: it falls, bears on the floor, bounces without gaining
// energy, and stays whole.
TEST_P(EveryForm, FallsAndBouncesWithoutGainingEnergy) {
    const auto [order, model] = GetParam();
    FormApp app(-9.81);
    dCreatePlane(app.space, 0, 0, 1, 0);
    dSoftBodyID cube = app.add_cube(0.1, 2);
    ASSERT_EQ(dSoftBodySetOrder(cube, order), 1);
    ASSERT_EQ(dSoftBodySetMaterialModel(cube, model), 1);
    EXPECT_STREQ(dSoftBodyGetMaterialModel(cube), model);
    const dQuaternion q = {std::cos(0.2), std::sin(0.2), 0, 0};
    dSoftBodyRotate(cube, q);
    dSoftBodySetPosition(cube, 0, 0, 0.3);
    const auto energy = [&] {
        const dSoftEnergy e = dSoftBodyGetEnergy(cube);
        return e.kinetic + e.elastic + 9.81 * height(cube);
    };
    const double start = energy();
    double lowest = 1, after = 0, sum = 0;
    int flying = 0;
    for (int i = 0; i < 120; ++i) {
        app.step(kStep);
        const double z = height(cube);
        if (z < lowest)
            lowest = z, after = z, sum = 0, flying = 0;
        after = std::max(after, z);
        if (status_of(cube).contact_points == 0)
            sum += energy(), ++flying;
    }
    EXPECT_FALSE(status_of(cube).stopped) << FormApp::heard();
    EXPECT_GT(lowest, 0.02);
    EXPECT_LT(lowest, 0.06);
    EXPECT_GT(after, lowest + 0.02);
    // Velocities lag by half a substep, so that one look errs by up to half the energy of the
    // fastest mode (some 4 % of the whole, seen), either way: the mean over a flight does not.
    ASSERT_GT(flying, 20);
    EXPECT_LT(sum / flying, 1.01 * start);
}

INSTANTIATE_TEST_SUITE_P(BodyForm, EveryForm,
                         testing::Combine(testing::Values(1, 2),
                                          testing::Values("stvk", "corotated",
                                                          "stable-neo-hookean")));

TEST(BodyForm, MomentumIsKeptWhenAQuadraticBodyIsStruck) {
    FormApp app;
    dSoftBodyID cube = app.add_cube(0.1, 2);
    ASSERT_EQ(dSoftBodySetOrder(cube, 2), 1);
    dBodyID ball = app.add_sphere(0.03, 0.5, 0.1);
    dBodySetPosition(ball, 0.011, 0.007, 0.1);
    dBodySetLinearVel(ball, 0, 0, -2);
    for (int i = 0; i < 24; ++i)
        app.step(kStep);
    dVector3 p, l;
    dSoftBodyGetMomentum(cube, p, l);
    const dReal* v = dBodyGetLinearVel(ball);
    EXPECT_NEAR(p[0] + 0.5 * v[0], 0, 1e-12); // to rounding: 1 kg m/s changes hands
    EXPECT_NEAR(p[1] + 0.5 * v[1], 0, 1e-12);
    EXPECT_NEAR(p[2] + 0.5 * v[2], -1, 1e-12);
    EXPECT_GT(v[2], -1.5) << "the ball was never stopped";
}

// A free steel bar, 1 cell thick: Euler-Bernoulli's first partial is 1.0279 t/L^2 sqrt(E/rho) =
// 518.8 Hz for t = 0.01, L = 0.316; shear and rotary inertia take some 0.4 % of it.
TEST(BodyForm, ModesAreThoseOfTheOrder) {
    FormApp app;
    MeshHandle mesh(dSoftMeshCreateBar(0.316, 0.02, 0.01, 16, 1, 1));
    const dSoftSolid steel = dSoftSolidDefault();
    dSoftBodyID bar = dSoftBodyCreate(app.soft, mesh, &steel);
    const double expected =
        1.0279 * 0.01 / (0.316 * 0.316) * std::sqrt(steel.young / steel.density);
    dReal linear = 0, quadratic = 0;
    ASSERT_EQ(dSoftBodyGetModes(bar, 1, &linear), 1);
    ASSERT_EQ(dSoftBodySetOrder(bar, 2), 1);
    ASSERT_EQ(dSoftBodyGetModes(bar, 1, &quadratic), 1);
    EXPECT_GT(linear, 1.3 * expected);
    EXPECT_NEAR(quadratic, 0.996 * expected, 0.02 * expected);
}

// A force at the bar's end, one step long, then the period between crossings of that node's height.
TEST(BodyForm, AQuadraticBodyRingsAtTheModeItPredicts) {
    FormApp app;
    MeshHandle mesh(dSoftMeshCreateBar(0.1, 0.02, 0.01, 5, 1, 1));
    dSoftSolid solid = jelly(200e6);
    dSoftBodyID bar = dSoftBodyCreate(app.soft, mesh, &solid);
    ASSERT_EQ(dSoftBodySetOrder(bar, 2), 1);
    std::vector<int> end; // clamped, in the mesh's own numbers
    const auto x = packed(bar, dSoftBodyGetPositions);
    int tip = 0;
    for (int i = 0; i < static_cast<int>(x.size() / 3); ++i) {
        if (x[static_cast<std::size_t>(3 * i)] < 1e-9)
            end.push_back(i);
        if (x[static_cast<std::size_t>(3 * i)] > x[static_cast<std::size_t>(3 * tip)])
            tip = i;
    }
    dSoftBodyPinNodes(bar, end.data(), static_cast<int>(end.size()));
    dReal modes[1];
    ASSERT_EQ(dSoftBodyGetModes(bar, 1, modes), 1);
    const double h = 0.02 / modes[0];
    dSoftBodyAddForceAtNode(bar, tip, 0, 0, 1e-5);
    std::vector<double> z;
    const double rest = x[static_cast<std::size_t>(3 * tip + 2)];
    for (int i = 0; i < 1010; ++i) {
        app.step(h);
        z.push_back(packed(bar, dSoftBodyGetPositions)[static_cast<std::size_t>(3 * tip + 2)] -
                    rest);
    }
    // Twenty periods hold the mode's frequency to a fraction of a per cent: it carries nearly all
    // of the tip's motion, others scatter the crossings within a period, as 1/20 of it.
    double best = 0, strongest = 0;
    for (double ratio = 0.9; ratio <= 1.1; ratio += 0.001) {
        double c = 0, s = 0;
        for (std::size_t i = 0; i < z.size(); ++i) {
            const double phase = 2 * M_PI * ratio * modes[0] * h * static_cast<double>(i);
            const double hann = 1 - std::cos(2 * M_PI * static_cast<double>(i) / 1009);
            c += hann * z[i] * std::cos(phase), s += hann * z[i] * std::sin(phase);
        }
        if (std::hypot(c, s) > strongest)
            strongest = std::hypot(c, s), best = ratio;
    }
    EXPECT_NEAR(best, 1, 0.003);
}

TEST(BodyForm, PromotedClampHoldsTheMiddlesOfItsEdges) {
    const auto lowest_mode = [](bool pin_first) {
        FormApp app;
        MeshHandle mesh(dSoftMeshCreateBar(0.1, 0.02, 0.01, 5, 1, 1));
        const dSoftSolid solid = jelly();
        dSoftBodyID bar = dSoftBodyCreate(app.soft, mesh, &solid);
        const auto x = packed(bar, dSoftBodyGetPositions);
        std::vector<int> end;
        for (int i = 0; i < static_cast<int>(x.size() / 3); ++i)
            if (x[static_cast<std::size_t>(3 * i)] < 1e-9)
                end.push_back(i);
        int held = 4;
        if (!pin_first)
            dSoftBodySetOrder(bar, 2);
        held = dSoftBodyPinNodes(bar, end.data(), static_cast<int>(end.size()));
        EXPECT_EQ(held, pin_first ? 4 : 9); // a face of two triangles: four corners, five edges
        dSoftBodySetOrder(bar, 2);
        dReal f = 0;
        dSoftBodyGetModes(bar, 1, &f);
        return f;
    };
    EXPECT_EQ(lowest_mode(true), lowest_mode(false));
}

TEST(BodyForm, CurvedSphereHasTheSpheresVolume) {
    FormApp app;
    MeshHandle mesh(dSoftMeshCreateSphere(0.1, 4));
    const dSoftSolid solid = jelly();
    dSoftBodyID ball = dSoftBodyCreate(app.soft, mesh, &solid);
    EXPECT_EQ(dSoftBodySetCurved(ball, 1, nullptr), 0) << "linear elements cannot be curved";
    EXPECT_NE(FormApp::heard().find("order 2"), std::string::npos) << FormApp::heard();
    ASSERT_EQ(dSoftBodySetOrder(ball, 2), 1);
    const double full = 1000 * 4.0 / 3 * M_PI * 1e-3;
    const double flat = dSoftBodyGetMass(ball);
    int moved = 0;
    ASSERT_EQ(dSoftBodySetCurved(ball, 1, &moved), 1);
    EXPECT_GT(moved, 0);
    const double curved = dSoftBodyGetMass(ball);
    EXPECT_LT(std::abs(curved - full), 0.1 * std::abs(flat - full));
    ASSERT_EQ(dSoftBodySetCurved(ball, 0, &moved), 1);
    EXPECT_EQ(dSoftBodyGetMass(ball), flat);
}

TEST(BodyForm, IsRefusedWithASentenceAfterTheFirstStepAndForNonsense) {
    FormApp app;
    dSoftBodyID cube = app.add_cube(0.1, 1);
    EXPECT_EQ(dSoftBodySetOrder(cube, 3), 0);
    EXPECT_NE(FormApp::heard().find("order 3"), std::string::npos);
    EXPECT_EQ(dSoftBodySetMaterialModel(cube, "jam"), 0);
    EXPECT_NE(FormApp::heard().find("corotated"), std::string::npos) << "must list the known ones";
    EXPECT_STREQ(dSoftBodyGetMaterialModel(cube), "stvk");
    app.step(kStep);
    for (const bool order : {true, false}) {
        FormApp::heard().clear();
        EXPECT_EQ(order ? dSoftBodySetOrder(cube, 2) : dSoftBodySetMaterialModel(cube, "corotated"),
                  0);
        EXPECT_NE(FormApp::heard().find("first step"), std::string::npos);
    }
    EXPECT_EQ(dSoftBodyGetOrder(cube), 1);
    app.step(kStep);
}

// A cube whose lower half is three times as dense and far more damped.
TEST(BodyForm, GroupsHaveTheirOwnSolids) {
    const std::string path = testing::TempDir() + "two_tets.msh";
    std::FILE* file = std::fopen(path.c_str(), "w");
    ASSERT_NE(file, nullptr);
    std::fputs("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
               "$PhysicalNames\n2\n3 1 \"light\"\n3 2 \"heavy\"\n$EndPhysicalNames\n"
               "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 0 0 -1\n$EndNodes\n"
               "$Elements\n2\n1 4 2 1 1 1 2 3 4\n2 4 2 2 2 1 3 2 5\n$EndElements\n",
               file);
    std::fclose(file);
    FormApp app;
    MeshHandle mesh(dSoftMeshLoad(path.c_str()));
    std::remove(path.c_str());
    ASSERT_TRUE(mesh) << FormApp::heard();
    dSoftSolid solids[2] = {jelly(), jelly()};
    solids[1].density = 3000;
    solids[1].alpha = 50;
    for (const int count : {0, 3}) {
        EXPECT_EQ(dSoftBodyCreateGroups(app.soft, mesh, solids, count), nullptr);
        EXPECT_NE(FormApp::heard().find("2 groups"), std::string::npos) << FormApp::heard();
    }
    dSoftBodyID one = dSoftBodyCreateGroups(app.soft, mesh, solids, 1);
    EXPECT_NEAR(dSoftBodyGetMass(one), 1000 / 3.0, 1e-9); // two tetrahedra of 1/6 m^3
    dSoftBodyDestroy(one);
    for (const int order : {1, 2}) {
        dSoftBodyID both = dSoftBodyCreateGroups(app.soft, mesh, solids, 2);
        ASSERT_NE(both, nullptr) << FormApp::heard();
        ASSERT_EQ(dSoftBodySetOrder(both, order), 1);
        EXPECT_NEAR(dSoftBodyGetMass(both), 4000 / 6.0, 1e-9);
        EXPECT_NEAR(height(both), (1000 * 0.25 - 3000 * 0.25) / 4000, 1e-12);
        // Damping takes deformation, not momentum, though it differs from node to node.
        dSoftBodyAddForceAtNode(both, 3, 1e4, -2e4, 3e4);
        app.step(0.01);
        dVector3 p1, l1, p2, l2;
        dSoftBodyGetMomentum(both, p1, l1);
        const double before = dSoftBodyGetEnergy(both).kinetic + dSoftBodyGetEnergy(both).elastic;
        for (int i = 0; i < 20; ++i)
            app.step(0.01);
        dSoftBodyGetMomentum(both, p2, l2);
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(p2[axis], p1[axis], 1e-9) << order; // of 100 to 300 kg m/s
        EXPECT_LT(dSoftBodyGetEnergy(both).kinetic + dSoftBodyGetEnergy(both).elastic, before);
        dSoftBodyDestroy(both);
    }
}

} // namespace
