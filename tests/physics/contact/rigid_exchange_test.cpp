// Soft and rigid bodies together under ODE's own step, through the public interface alone.
#include <ode_softbody/softbody.h>

#include <gtest/gtest.h>
#include <ode/ode.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <cstdio>
#include <vector>

namespace {

using Vec3 = Eigen::Vector3d;

Vec3 vec(const dReal* v) { return {v[0], v[1], v[2]}; }

/// An application that knows nothing of soft bodies once they are made.
class App {
public:
    App() {
        dInitODE2(0);
        world = dWorldCreate();
        space = dHashSpaceCreate(nullptr);
        contacts = dJointGroupCreate(0);
        soft = dSoftWorldCreate(world, space);
    }
    ~App() {
        dJointGroupDestroy(contacts);
        dSpaceDestroy(space);
        dWorldDestroy(world);
        dCloseODE();
    }

    void step(dReal h, int (*how)(dWorldID, dReal) = &dWorldQuickStep) {
        dSpaceCollide(space, this, &App::near);
        how(world, h);
        dJointGroupEmpty(contacts);
    }

    dSoftBodyID soft_box(double side, int cells, dReal young, dReal density, dReal beta = 1e-5) {
        const dSoftMeshID mesh = dSoftMeshCreateBox(side, side, side, cells, cells, cells);
        dSoftSolid solid = dSoftSolidDefault();
        solid.young = young;
        solid.poisson = 0.3;
        solid.density = density;
        solid.alpha = 0; // drag against space would take momentum
        solid.beta = beta;
        const dSoftBodyID body = dSoftBodyCreate(soft, mesh, &solid);
        dSoftMeshDestroy(mesh);
        return body;
    }

    dBodyID rigid_box(const Vec3& sides, dReal mass) {
        const dBodyID body = dBodyCreate(world);
        dMass m;
        dMassSetBoxTotal(&m, mass, sides.x(), sides.y(), sides.z());
        dBodySetMass(body, &m);
        dGeomSetBody(dCreateBox(space, sides.x(), sides.y(), sides.z()), body);
        return body;
    }

    static void near(void* data, dGeomID a, dGeomID b) {
        App& app = *static_cast<App*>(data);
        ++app.calls;
        app.saw_soft |= dSoftGeomGetSoftBody(a) || dSoftGeomGetSoftBody(b);
    }

    dWorldID world;
    dSpaceID space;
    dJointGroupID contacts;
    dSoftWorldID soft;
    int calls = 0;
    bool saw_soft = false;
};

TEST(RigidExchange, StepsOfOdeReachTheLibraryFirst) {
    App app;
    EXPECT_EQ(dSoftWorldGetHook(app.soft), dSoftHookInterposed);
    app.step(0.01, &dWorldStep);
    app.step(0.01, &dWorldQuickStep);
    dSoftWorldStep(app.soft, 0.01, &dWorldQuickStep);
    EXPECT_NEAR(dSoftWorldGetTime(app.soft), 0.03, 1e-15); // the nested step is passed through
}

TEST(RigidExchange, SoftBoxComesToRestOnAFloorThatTheCallbackKnows) {
    App app;
    dWorldSetGravity(app.world, 0, 0, -9.81);
    dCreatePlane(app.space, 0, 0, 1, 0);
    const dSoftBodyID box = app.soft_box(0.1, 3, 2e5, 1000, 1e-3);
    dSoftBodySetPosition(box, 0, 0, 0.06);
    for (int i = 0; i < 800; ++i)
        app.step(0.005);
    dVector3 centre;
    dVector3 momentum;
    dVector3 spin;
    dSoftBodyGetCenterOfMass(box, centre);
    dSoftBodyGetMomentum(box, momentum, spin);
    EXPECT_LT(centre[2], 0.05);
    // Under its own weight it is shortened by rho g L^2 / 2E = 0.25 mm at the top, and the contact
    // springs, softer than the body where a substep allows no stiffer, give about as much again.
    EXPECT_GT(centre[2], 0.0490);
    EXPECT_LT(vec(momentum).norm(), 1e-5); // of 1 kg; its sway decays by e in 0.3 s
    EXPECT_FALSE(app.saw_soft);
}

/// Floors with their top at z = 0, in all the kinds that ODE has for one.
enum class Floor { plane, box, cylinder, trimesh, convex, heightfield };

class RestsOn : public testing::TestWithParam<Floor> {};

constexpr dReal kSlab[] = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1,
                           -1, -1, 0,  1, -1, 0,  -1, 1, 0,  1, 1, 0};
constexpr dTriIndex kSlabTriangle[] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                       2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
constexpr dReal kSlabPlane[] = {1, 0,  0, 1, -1, 0, 0, 1, 0, 1, 0,  1,
                                0, -1, 0, 1, 0,  0, 1, 0, 0, 0, -1, 1};
constexpr unsigned kSlabPolygon[] = {4, 1, 3, 7, 5, 4, 0, 4, 6, 2, 4, 2, 6, 7, 3,
                                     4, 0, 1, 5, 4, 4, 4, 5, 7, 6, 4, 0, 2, 3, 1};

dReal flat(void*, int, int) { return 0; }

TEST_P(RestsOn, AsOnAPlane) {
    App app;
    dWorldSetGravity(app.world, 0, 0, -9.81);
    const dTriMeshDataID triangles = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(triangles, kSlab, 3 * sizeof(dReal), 8, kSlabTriangle, 36,
                                3 * sizeof(dTriIndex));
    const dHeightfieldDataID field = dGeomHeightfieldDataCreate();
    dGeomHeightfieldDataBuildCallback(field, nullptr, &flat, 2, 2, 21, 21, 1, 0, 1, 0);
    dGeomHeightfieldDataSetBounds(field, -0.5, 0.5);
    dMatrix3 upright;
    dRFromAxisAndAngle(upright, 1, 0, 0, M_PI / 2); // height fields have y up
    switch (GetParam()) {
    case Floor::plane:
        dCreatePlane(app.space, 0, 0, 1, 0);
        break;
    case Floor::box:
        dGeomSetPosition(dCreateBox(app.space, 2, 2, 1), 0, 0, -0.5);
        break;
    case Floor::cylinder:
        dGeomSetPosition(dCreateCylinder(app.space, 1, 1), 0, 0, -0.5);
        break;
    case Floor::trimesh:
        dCreateTriMesh(app.space, triangles, nullptr, nullptr, nullptr);
        break;
    case Floor::convex:
        dCreateConvex(app.space, kSlabPlane, 6, kSlab, 8, kSlabPolygon);
        break;
    case Floor::heightfield:
        dGeomSetRotation(dCreateHeightfield(app.space, field, 1), upright);
        break;
    }
    const dSoftBodyID box = app.soft_box(0.1, 3, 2e5, 1000, 1e-3);
    dSoftBodySetPosition(box, 0.013, 0.021, 0.06);
    for (int i = 0; i < 300; ++i)
        app.step(0.005);
    dVector3 centre;
    dVector3 momentum;
    dVector3 spin;
    dSoftBodyGetCenterOfMass(box, centre);
    dSoftBodyGetMomentum(box, momentum, spin);
    std::printf("centre of mass %.4f mm up, moved %.2f %.2f mm, momentum %.1e\n", 1e3 * centre[2],
                1e3 * (centre[0] - 0.013), 1e3 * (centre[1] - 0.021), vec(momentum).norm());
    EXPECT_LT(centre[2], 0.05); // as above; a third of the contact stiffness on probed kinds
    EXPECT_GT(centre[2], 0.0480);
    EXPECT_LT(vec(momentum).norm(), 0.02); // of 1 kg: it may still sway
    EXPECT_LT(std::hypot(centre[0] - 0.013, centre[1] - 0.021), 5e-3);
    dGeomTriMeshDataDestroy(triangles);
    dGeomHeightfieldDataDestroy(field);
}

INSTANTIATE_TEST_SUITE_P(Floors, RestsOn,
                         testing::Values(Floor::plane, Floor::box, Floor::cylinder, Floor::trimesh,
                                         Floor::convex, Floor::heightfield));

/// Largest departure of the force that holds a body up from its weight, over some steps, in
/// weights.
template <class Momentum>
double ripple(App& app, double weight, dReal h, int steps, Momentum momentum_up) {
    double worst = 0;
    double before = momentum_up();
    for (int i = 0; i < steps; ++i) {
        app.step(h);
        const double now = momentum_up();
        worst = std::fmax(worst, std::fabs(now - before) / h / weight);
        before = now;
    }
    return worst;
}

double momentum_up(dSoftBodyID body) {
    dVector3 momentum;
    dVector3 spin;
    dSoftBodyGetMomentum(body, momentum, spin);
    return momentum[2];
}

TEST(RestingLoad, OfASoftCubeDoesNotRipple) {
    for (const bool on_box : {false, true}) {
        App app;
        dWorldSetGravity(app.world, 0, 0, -9.81);
        if (on_box)
            dGeomSetPosition(dCreateBox(app.space, 1, 1, 1), 0, 0, -0.5);
        else
            dCreatePlane(app.space, 0, 0, 1, 0);
        const dSoftBodyID cube = app.soft_box(0.1, 3, 2e5, 1000, 1e-3);
        dSoftBodySetPosition(cube, 0, 0, 0.06);
        for (int i = 0; i < 600; ++i)
            app.step(0.005);
        const double worst = ripple(app, 9.81 * dSoftBodyGetMass(cube), 0.005, 40,
                                    [&] { return momentum_up(cube); });
        std::printf("on a %s: ripple %.1e of the weight\n", on_box ? "box" : "plane", worst);
        EXPECT_LT(worst, 0.01);
    }
}

TEST(RestingLoad, OfARigidBoxOnASoftOneDoesNotRipple) {
    App app;
    dWorldSetGravity(app.world, 0, 0, -9.81);
    dCreatePlane(app.space, 0, 0, 1, 0);
    const dSoftBodyID cube = app.soft_box(0.1, 3, 2e5, 1000, 1e-3);
    dSoftBodySetPosition(cube, 0, 0, 0.051);
    const dBodyID box = app.rigid_box({0.06, 0.06, 0.04}, 0.3);
    dBodySetPosition(box, 0.004, 0.007, 0.125);
    for (int i = 0; i < 800; ++i)
        app.step(0.005);
    const double worst =
        ripple(app, 9.81 * 0.3, 0.005, 40, [&] { return 0.3 * double(dBodyGetLinearVel(box)[2]); });
    const Vec3 at = vec(dBodyGetPosition(box));
    std::printf("rigid on soft: ripple %.1e of the weight; at %.2f %.2f %.2f mm\n", worst,
                1e3 * at.x(), 1e3 * at.y(), 1e3 * at.z());
    EXPECT_LT(worst, 0.01);
    EXPECT_GT(at.z(), 0.11);
}

struct Throw {
    double mass_ratio; ///< rigid to soft
    double h;
};

class Collision : public testing::TestWithParam<Throw> {};

// A spinning rigid cube meets a free soft one. What an application reads from ODE and from the
// library adds up to the same momenta as before, to rounding.
TEST_P(Collision, KeepsMomenta) {
    const auto [ratio, h] = GetParam();
    App app;
    const dSoftBodyID soft = app.soft_box(0.1, 3, 1e6, 1000);
    const double mass = ratio * dSoftBodyGetMass(soft);
    const dBodyID rigid = app.rigid_box({0.06, 0.06, 0.06}, mass);
    dBodySetPosition(rigid, 0.01, 0.02, 0.1);
    dBodySetLinearVel(rigid, 0.2, 0, -2);
    dBodySetAngularVel(rigid, 3, -8, 5);
    dMass m;
    dBodyGetMass(rigid, &m);
    const auto total = [&] {
        dVector3 linear;
        dVector3 angular;
        dSoftBodyGetMomentum(soft, linear, angular);
        const Vec3 p = mass * vec(dBodyGetLinearVel(rigid));
        const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> r(
            dBodyGetRotation(rigid));
        const Eigen::Matrix3d turn = r.leftCols<3>();
        const Vec3 spin = turn * Vec3(Vec3(m.I[0], m.I[5], m.I[10]).asDiagonal() *
                                      (turn.transpose() * vec(dBodyGetAngularVel(rigid))));
        return std::pair<Vec3, Vec3>(vec(linear) + p,
                                     vec(angular) + spin + vec(dBodyGetPosition(rigid)).cross(p));
    };
    const auto before = total();
    double least_up = 0;
    for (double t = 0; t < 0.1; t += h) {
        app.step(h);
        least_up = std::fmax(least_up, dBodyGetLinearVel(rigid)[2] + 2);
    }
    const auto after = total();
    EXPECT_GT(least_up, 0.02); // they met
    // A relative rounding of 1e-16 a node and substep, growing as a random walk over 1e4 substeps;
    // orientation and inertia of the rigid body are rounded at every hand-over of ODE's.
    EXPECT_LT((after.first - before.first).norm(), 1e-12 * before.first.norm());
    EXPECT_LT((after.second - before.second).norm(), 1e-11 * before.second.norm());
}

INSTANTIATE_TEST_SUITE_P(MassRatioAndStep, Collision,
                         testing::Values(Throw{1e-3, 5e-3}, Throw{1e-1, 5e-3}, Throw{1, 1e-3},
                                         Throw{1, 5e-3}, Throw{1, 16e-3}, Throw{1e2, 5e-3}));

TEST(RigidExchange, EndsInAnyOrder) {
    for (int order = 0; order < 3; ++order) {
        App app;
        const dSoftBodyID box = app.soft_box(0.1, 1, 1e6, 1000);
        app.rigid_box({0.05, 0.05, 0.05}, 1);
        app.step(0.005);
        if (order == 0)
            dGeomDestroy(dSoftBodyGetGeom(box)); // the body lives on and meets nothing
        if (order == 1)
            dSoftWorldDestroy(app.soft);
        if (order == 2)
            dSoftBodyDestroy(box);
        app.step(0.005);
    } // space, world and ODE go; the next round starts ODE again
}

} // namespace
