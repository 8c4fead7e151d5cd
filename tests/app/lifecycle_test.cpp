// Unchanged ODE programs in all their habits: soft bodies live and end with what they are in.
#include "support/soft_app.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <thread>

namespace {

using namespace ode::soft;
using namespace ode::test;

constexpr dReal kStep = 1.0 / 240; // [s]

void near_nothing(void*, dGeomID, dGeomID) {}

/// Heights of a cube dropped on a plane and met by a ball, in a space made by `make`.
std::vector<dReal> fall_in(const std::function<dSpaceID()>& make, bool nested) {
    dInitODE2(0);
    const dWorldID world = dWorldCreate();
    dWorldSetGravity(world, 0, 0, -9.81);
    const dSpaceID space = make();
    const dSpaceID inner = nested ? dSimpleSpaceCreate(space) : space;
    const dSpaceID innermost = nested ? dHashSpaceCreate(inner) : space;
    dCreatePlane(innermost, 0, 0, 1, 0);
    const dSoftWorldID soft = dSoftWorldCreate(world, space);
    const dSoftBodyID cube = add_cube(soft, 0.1, 0.07);
    const dBodyID ball = dBodyCreate(world);
    const dGeomID shape = dCreateSphere(inner, 0.03);
    dGeomSetBody(shape, ball);
    dBodySetPosition(ball, 0.01, 0.02, 0.2);
    dMass mass;
    dMassSetSphereTotal(&mass, 0.1, 0.03);
    dBodySetMass(ball, &mass);
    std::vector<dReal> heights;
    for (int i = 0; i < 60; ++i) {
        dSpaceCollide(space, nullptr, near_nothing);
        dWorldQuickStep(world, kStep);
        heights.push_back(height_of(cube));
        heights.push_back(dBodyGetPosition(ball)[2]);
    }
    dSpaceDestroy(space);
    dWorldDestroy(world);
    dCloseODE();
    return heights;
}

TEST(Lifecycle, AllFourKindsOfSpaceGiveTheSameBits) {
    const auto simple = fall_in([] { return dSimpleSpaceCreate(nullptr); }, false);
    EXPECT_GT(*std::min_element(simple.begin(), simple.end()), 0.03) << "something sank through";
    EXPECT_GT(simple.back(), 0.08) << "the ball passed the cube";
    EXPECT_EQ(simple, fall_in([] { return dHashSpaceCreate(nullptr); }, false));
    EXPECT_EQ(simple, fall_in(
                          [] {
                              const dVector3 center = {0, 0, 0, 0}, extents = {10, 10, 10, 0};
                              return dQuadTreeSpaceCreate(nullptr, center, extents, 4);
                          },
                          false));
    EXPECT_EQ(simple,
              fall_in([] { return dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ); }, false));
}

TEST(Lifecycle, NestedSpacesGiveTheSameBits) {
    const auto flat = fall_in([] { return dHashSpaceCreate(nullptr); }, false);
    EXPECT_EQ(flat, fall_in([] { return dHashSpaceCreate(nullptr); }, true));
}

// The soft body's space against another one: pairs come from the application's own call.
TEST(Lifecycle, SpacesCollidedWithEachOtherMeet) {
    dInitODE2(0);
    const dWorldID world = dWorldCreate();
    dWorldSetGravity(world, 0, 0, -9.81);
    const dSpaceID moving = dHashSpaceCreate(nullptr);
    const dSpaceID scenery = dSimpleSpaceCreate(nullptr);
    dCreatePlane(scenery, 0, 0, 1, 0);
    const dSoftBodyID cube = add_cube(dSoftWorldCreate(world, moving), 0.1, 0.07);
    for (int i = 0; i < 60; ++i) {
        dSpaceCollide2(reinterpret_cast<dGeomID>(moving), reinterpret_cast<dGeomID>(scenery),
                       nullptr, near_nothing);
        dWorldStep(world, kStep);
        EXPECT_GT(height_of(cube), 0.03) << i;
    }
    // Between collision and step the scenery goes: nothing may remember it.
    dSpaceCollide2(reinterpret_cast<dGeomID>(moving), reinterpret_cast<dGeomID>(scenery), nullptr,
                   near_nothing);
    dSpaceDestroy(scenery);
    for (int i = 0; i < 60; ++i)
        dWorldStep(world, kStep);
    EXPECT_LT(height_of(cube), 0);
    dWorldDestroy(world);
    dSpaceDestroy(moving);
    dCloseODE();
}

TEST(Lifecycle, GeomsMayGoBetweenCollisionAndStep) {
    OdeApp app(-9.81);
    const dSoftWorldID soft = dSoftWorldCreate(app.world, app.space);
    const dSoftBodyID cube = add_cube(soft, 0.1, 0.05);
    for (int i = 0; i < 40; ++i) {
        const dGeomID floor = dCreateBox(app.space, 1, 1, 0.1);
        dGeomSetPosition(floor, 0, 0, -0.05);
        const dBodyID ball = app.add_sphere(0.03, 0.1, 0.12);
        const dGeomID shape = dBodyGetFirstGeom(ball);
        dSpaceCollide(app.space, nullptr, near_nothing);
        dGeomDestroy(i % 2 ? floor : shape);
        if (i % 3)
            dBodyDestroy(ball);
        dWorldStep(app.world, kStep);
        dGeomDestroy(i % 2 ? shape : floor);
        if (i % 3 == 0)
            dBodyDestroy(ball);
    }
    EXPECT_TRUE(std::isfinite(height_of(cube)));
}

/// A program that makes and destroys everything in an order of chance, stepping in between.
void live_by_chance(unsigned seed) {
    std::mt19937 random(seed);
    const auto chance = [&](int n) {
        return static_cast<int>(random() % static_cast<unsigned>(n));
    };
    dInitODE2(0);
    dWorldID world = dWorldCreate();
    dWorldSetGravity(world, 0, 0, -9.81);
    dSpaceID space = dHashSpaceCreate(nullptr);
    dSpaceSetCleanup(space, chance(2));
    dSpaceID inner = chance(2) ? dSimpleSpaceCreate(space) : nullptr;
    dSoftWorldID soft = dSoftWorldCreate(world, space);
    std::vector<dSoftBodyID> cubes;
    std::vector<dBodyID> bodies;
    std::vector<dGeomID> geoms;
    const bool cleanup = dSpaceGetCleanup(space) != 0;
    if (inner)
        dSpaceSetCleanup(inner, cleanup);
    geoms.push_back(dCreatePlane(space, 0, 0, 1, 0));
    for (int i = 0; i < 3; ++i) {
        cubes.push_back(add_cube(soft, 0.1, 0.06 + 0.15 * i, 1));
        bodies.push_back(dBodyCreate(world));
        dBodySetPosition(bodies.back(), 0.02, 0, 0.15 + 0.15 * i);
        geoms.push_back(dCreateSphere(inner && chance(2) ? inner : space, 0.03));
        dGeomSetBody(geoms.back(), bodies.back());
        const int node = chance(8);
        if (chance(2))
            dSoftBodyAttachNodes(cubes.back(), bodies.back(), &node, 1);
    }
    const auto step = [&] {
        if (space && chance(2))
            dSpaceCollide(space, nullptr, near_nothing);
        if (world)
            chance(2) ? dWorldStep(world, 0.002) : dWorldQuickStep(world, 0.002);
    };
    std::vector<std::function<void()>> ends;
    for (const dSoftBodyID cube : cubes)
        ends.push_back([=] { dSoftBodyDestroy(cube); });
    for (std::size_t i = 0; i < bodies.size(); ++i)
        ends.push_back([&, i] {
            if (world)
                dBodyDestroy(bodies[i]);
        });
    for (std::size_t i = 0; i < geoms.size(); ++i)
        ends.push_back([&, i] {
            if (space || !cleanup)
                dGeomDestroy(geoms[i]);
        });
    ends.push_back([&] { dSoftWorldDestroy(soft); });
    ends.push_back([&] {
        dWorldDestroy(world);
        world = nullptr;
    });
    ends.push_back([&] {
        if (inner && !cleanup)
            dSpaceDestroy(inner);
        inner = nullptr;
        dSpaceDestroy(space);
        space = nullptr;
    });
    std::shuffle(ends.begin(), ends.end(), random);
    if (chance(4) == 0)
        ends.resize(ends.size() / 2); // and closes ODE on what is left
    for (const auto& end : ends) {
        end();
        step();
    }
    dCloseODE();
}

TEST(Lifecycle, EverythingMayEndInAnyOrder) {
    const Messages quiet;
    for (unsigned seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        live_by_chance(seed);
    }
}

TEST(Lifecycle, OdeMayBeClosedAndStartedAgain) {
    std::vector<dReal> first;
    for (int life = 0; life < 3; ++life) {
        dInitODE2(0);
        // Somebody else's geom class takes our number in one of the lives.
        if (life == 1) {
            dGeomClass other{};
            other.aabb = [](dGeomID, dReal box[6]) { std::fill(box, box + 6, 0.0); };
            other.collider = [](int) -> dColliderFn* { return nullptr; };
            dCreateGeomClass(&other);
        }
        const dWorldID world = dWorldCreate();
        dWorldSetGravity(world, 0, 0, -9.81);
        const dSpaceID space = dHashSpaceCreate(nullptr);
        dCreatePlane(space, 0, 0, 1, 0);
        const dSoftBodyID cube = add_cube(dSoftWorldCreate(world, space), 0.1, 0.07);
        std::vector<dReal> heights;
        for (int i = 0; i < 40; ++i) {
            dWorldStep(world, kStep);
            heights.push_back(height_of(cube));
        }
        if (life == 0)
            first = heights;
        EXPECT_EQ(heights, first) << life;
        dCloseODE(); // the rest is left behind
    }
}

TEST(Lifecycle, AnotherThreadMayStep) {
    OdeApp app(-9.81);
    dCreatePlane(app.space, 0, 0, 1, 0);
    const dSoftBodyID cube = add_cube(dSoftWorldCreate(app.world, app.space), 0.1, 0.07);
    std::thread([&] {
        dAllocateODEDataForThread(dAllocateMaskAll);
        for (int i = 0; i < 60; ++i)
            app.step(kStep);
        dCleanupODEAllDataForThread();
    }).join();
    EXPECT_GT(height_of(cube), 0.03);
    EXPECT_LT(height_of(cube), 0.07);
}

/// Runs a world of its own and returns the cube's heights.
/// @param threads  of ODE's pool; 0: the calling one, but not by ODE's default implementation,
/// which
///                 worlds stepped at once must not share.
std::vector<dReal> run_alone(dReal from, int threads) {
    dAllocateODEDataForThread(dAllocateMaskAll);
    const dWorldID world = dWorldCreate();
    dWorldSetGravity(world, 0, 0, -9.81);
    const dSpaceID space = dHashSpaceCreate(nullptr);
    dCreatePlane(space, 0, 0, 1, 0);
    dThreadingThreadPoolID pool = nullptr;
    const dThreadingImplementationID implementation =
        threads > 0 ? dThreadingAllocateMultiThreadedImplementation()
                    : dThreadingAllocateSelfThreadedImplementation();
    dWorldSetStepThreadingImplementation(
        world, dThreadingImplementationGetFunctions(implementation), implementation);
    if (threads > 0) {
        pool = dThreadingAllocateThreadPool(static_cast<unsigned>(threads), 0, dAllocateMaskAll,
                                            nullptr);
        dThreadingThreadPoolServeMultiThreadedImplementation(pool, implementation);
    }
    const dSoftWorldID soft = dSoftWorldCreate(world, space);
    const dSoftBodyID cube = add_cube(soft, 0.1, from);
    const dBodyID ball = dBodyCreate(world);
    const dGeomID shape = dCreateSphere(space, 0.03);
    dGeomSetBody(shape, ball);
    dBodySetPosition(ball, 0.01, 0.02, 0.2);
    std::vector<dReal> heights;
    for (int i = 0; i < 60; ++i) {
        dWorldStep(world, kStep);
        heights.push_back(height_of(cube));
        heights.push_back(dBodyGetPosition(ball)[2]);
    }
    dWorldDestroy(world);
    dSpaceDestroy(space);
    if (pool) {
        dThreadingImplementationShutdownProcessing(implementation);
        dThreadingFreeThreadPool(pool);
    }
    dThreadingFreeImplementation(implementation);
    dCleanupODEAllDataForThread();
    return heights;
}

TEST(Lifecycle, OdesThreadPoolChangesNothing) {
    dInitODE2(0);
    EXPECT_EQ(run_alone(0.07, 0), run_alone(0.07, 2));
    dCloseODE();
}

TEST(Lifecycle, TwoWorldsAtOnceAreAsAlone) {
    dInitODE2(0);
    const std::vector<dReal> low = run_alone(0.06, 0);
    const std::vector<dReal> high = run_alone(0.08, 0);
    std::vector<dReal> low_too, high_too;
    std::thread one([&] { low_too = run_alone(0.06, 0); });
    std::thread other([&] { high_too = run_alone(0.08, 0); });
    one.join();
    other.join();
    EXPECT_EQ(low, low_too);
    EXPECT_EQ(high, high_too);
    dCloseODE();
}

} // namespace
