// A step allocates nothing: audio threads and games can't wait for a lock inside malloc.
#include "support/ode_app.h"

#include <ode_softbody/softbody.hpp>

#include <gtest/gtest.h>

#include <dlfcn.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<long> allocations{0};

void* counted(std::size_t size, std::size_t alignment) {
    ++allocations;
    void* p = nullptr;
    if (posix_memalign(&p, alignment, size != 0 ? size : 1) != 0)
        throw std::bad_alloc();
    return p;
}
} // namespace

// Replaces the allocation functions of the whole process, shared libraries included.
void* operator new(std::size_t size) { return counted(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
    return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

namespace {

using namespace ode::soft;

int no_rigid_step(dWorldID, dReal) { return 1; }

void step_allocates_nothing(bool damped_by_modes) {
    ode::test::OdeApp app(-9.81);
    WorldHandle soft(dSoftWorldCreate(app.world, app.space));
    dCreatePlane(app.space, 0, 0, 1, 0);
    dSoftSolid solid = dSoftSolidDefault();
    solid.young = 1e6;
    solid.density = 1000;
    const MeshHandle mesh(dSoftMeshCreateBox(0.1, 0.1, 0.1, 3, 3, 3));
    const dSoftBodyID body = dSoftBodyCreate(soft, mesh, &solid);
    dSoftBodySetModalDamping(body, damped_by_modes);
    dSoftBodySetPosition(body, 0, 0, 0.05);
    long views = 0;
    dSoftWorldAddSubstepObserver(
        soft, [](void* data, const dSoftSubstep*) { ++*static_cast<long*>(data); }, &views);
    for (int i = 0; i < 5; ++i) // a new contact may allocate its memory of friction
        dSoftWorldStep(soft, 0.004, no_rigid_step);

    const long before = allocations;
    for (int i = 0; i < 50; ++i)
        dSoftWorldStep(soft, 0.004, no_rigid_step);
    EXPECT_EQ(allocations - before, 0);
    EXPECT_GT(views, 0);
    dSoftStatus status{};
    status.struct_size = sizeof status;
    dSoftBodyGetStatus(body, &status);
    EXPECT_GT(status.contact_points, 0) << "the test must cover contact";
}

TEST(Allocation, StepWithContactAndObserverAllocatesNothing) { step_allocates_nothing(false); }

// But the first one, which finds the modes.
TEST(Allocation, StepDampedByModesAllocatesNothing) {
    setenv("ODE_SOFTBODY_CACHE", "", 1);
    step_allocates_nothing(true);
}

TEST(Allocation, StepOfAnAttachedBodyAllocatesNothing) {
    ode::test::OdeApp app;
    WorldHandle soft(dSoftWorldCreate(app.world, app.space));
    const dSoftSolid solid = dSoftSolidDefault();
    const MeshHandle mesh(dSoftMeshCreateBox(0.1, 0.1, 0.1, 2, 2, 2));
    const dSoftBodyID body = dSoftBodyCreate(soft, mesh, &solid);
    const dBodyID ball = app.add_sphere(0.03, 1, 0.1);
    const int nodes[] = {0, 1, 2};
    ASSERT_EQ(dSoftBodyAttachNodes(body, ball, nodes, 3), 3);
    for (int i = 0; i < 3; ++i)
        dSoftWorldStep(soft, 1e-4, no_rigid_step);
    const long before = allocations;
    for (int i = 0; i < 20; ++i)
        dSoftWorldStep(soft, 1e-4, no_rigid_step);
    EXPECT_EQ(allocations - before, 0);
}

int (*ode_step)(dWorldID, dReal);
void (*ode_collide)(dSpaceID, void*, dNearCallback*);

// A program that has no soft body, and one that has an empty soft world: what ODE allocates by
// itself and no more.
TEST(Allocation, IdlePlugInAllocatesNothing) {
    ode::test::OdeApp app(-9.81);
    dCreatePlane(app.space, 0, 0, 1, 0);
    for (int i = 0; i < 10; ++i)
        dBodySetPosition(app.add_sphere(0.1, 1, 0.1), i, 0, 0.1);
    void* ode = dlopen("libode.so.8", RTLD_NOW | RTLD_NOLOAD); // behind the interposed functions
    ASSERT_NE(ode, nullptr);
    ode_step = reinterpret_cast<int (*)(dWorldID, dReal)>(dlsym(ode, "dWorldQuickStep"));
    ode_collide =
        reinterpret_cast<void (*)(dSpaceID, void*, dNearCallback*)>(dlsym(ode, "dSpaceCollide"));
    ASSERT_NE(ode_step, &dWorldQuickStep);
    const auto near = [](void*, dGeomID, dGeomID) {};
    const auto counted_steps = [&](auto collide, auto step) {
        const long before = allocations;
        for (int i = 0; i < 50; ++i) {
            collide(app.space, nullptr, near);
            step(app.world, 1e-6);
        }
        return allocations - before;
    };
    counted_steps(ode_collide, ode_step); // its buffers
    const long own = counted_steps(ode_collide, ode_step);
    EXPECT_EQ(counted_steps(&dSpaceCollide, &dWorldQuickStep), own);
    const WorldHandle soft(dSoftWorldCreate(app.world, app.space));
    EXPECT_EQ(counted_steps(&dSpaceCollide, &dWorldQuickStep), own);
}

} // namespace
