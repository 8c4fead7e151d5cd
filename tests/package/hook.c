/* hook MODE [LIBRARY]: an ODE program whose soft cube must fall with its ball, and whose hook must
 * be MODE: interposed, threading or none. With LIBRARY the soft bodies come late, by dlopen with
 * RTLD_LOCAL, or RTLD_GLOBAL for a MODE that ends in "_global". */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <math.h>
#include <ode/ode.h>
#include <ode_softbody/softbody.h>
#include <stdio.h>
#include <string.h>

static int failures = 0;

static void check(int good, const char* what) {
    if (good)
        return;
    printf("failed: %s\n", what);
    ++failures;
}

/* The functions used, from wherever the library came. */
#define FUNCTION(name) __typeof__(name)* name##_
static struct {
    FUNCTION(dSoftWorldCreate);
    FUNCTION(dSoftWorldDestroy);
    FUNCTION(dSoftWorldGetHook);
    FUNCTION(dSoftWorldGetTime);
    FUNCTION(dSoftMeshCreateBox);
    FUNCTION(dSoftMeshDestroy);
    FUNCTION(dSoftSolidDefault);
    FUNCTION(dSoftBodyCreate);
    FUNCTION(dSoftBodySetPosition);
    FUNCTION(dSoftBodyGetCenterOfMass);
} soft;

static void find_functions(const char* library, int flags) {
    void* from = library ? dlopen(library, RTLD_NOW | flags) : RTLD_DEFAULT;
    if (library && !from)
        printf("%s\n", dlerror());
#define FIND(name) *(void**)(&soft.name##_) = dlsym(from, #name)
    FIND(dSoftWorldCreate);
    FIND(dSoftWorldDestroy);
    FIND(dSoftWorldGetHook);
    FIND(dSoftWorldGetTime);
    FIND(dSoftMeshCreateBox);
    FIND(dSoftMeshDestroy);
    FIND(dSoftSolidDefault);
    FIND(dSoftBodyCreate);
    FIND(dSoftBodySetPosition);
    FIND(dSoftBodyGetCenterOfMass);
}

static dReal height(dSoftBodyID body) {
    dVector3 center;
    soft.dSoftBodyGetCenterOfMass_(body, center);
    return center[2];
}

static void nothing(void* data, dGeomID a, dGeomID b) { (void)data, (void)a, (void)b; }

/* One life of the program: the world is stepped before there are soft bodies and after; with a
 * thread pool of the program's own when threads > 0. */
static void live(dSoftHook hook, const char* library, int flags, int (*step)(dWorldID, dReal),
                 int threads) {
    dInitODE2(0);
    dWorldID world = dWorldCreate();
    dThreadingImplementationID threading = NULL;
    dThreadingThreadPoolID pool = NULL;
    if (threads > 0) {
        threading = dThreadingAllocateMultiThreadedImplementation();
        pool = dThreadingAllocateThreadPool((unsigned)threads, 0, dAllocateMaskAll, NULL);
        dThreadingThreadPoolServeMultiThreadedImplementation(pool, threading);
        dWorldSetStepThreadingImplementation(world, dThreadingImplementationGetFunctions(threading),
                                             threading);
    }
    dSpaceID space = dHashSpaceCreate(NULL);
    dWorldSetGravity(world, 0, 0, -9.81);
    dBodyID ball = dBodyCreate(world);
    step(world, 0.001);
    find_functions(library, flags);
    check(soft.dSoftWorldCreate_ != NULL, "the library is there");
    if (failures)
        return;

    dSoftWorldID soft_world = soft.dSoftWorldCreate_(world, space);
    check(soft.dSoftWorldGetHook_(soft_world) == hook, "the hook is the one expected");
    dSoftSolid rubber = soft.dSoftSolidDefault_();
    rubber.young = 1e6;
    rubber.density = 1000;
    dSoftMeshID mesh = soft.dSoftMeshCreateBox_(0.1, 0.1, 0.1, 1, 1, 1);
    dSoftBodyID cube = soft.dSoftBodyCreate_(soft_world, mesh, &rubber);
    soft.dSoftMeshDestroy_(mesh);
    soft.dSoftBodySetPosition_(cube, 0, 0, 5);
    dBodySetPosition(ball, 0, 0, 5);
    dBodySetLinearVel(ball, 0, 0, 0);
    dReal time = 0;
    for (int i = 0; i < 50; ++i) {
        const dReal h = 0.002 + 0.0001 * (i % 7);
        dSpaceCollide(space, NULL, nothing);
        step(world, h);
        time += h;
    }
    const int moves = hook != dSoftHookNone;
    check(fabs(soft.dSoftWorldGetTime_(soft_world) - moves * time) < 1e-12,
          "the soft world's time is ODE's to rounding");
    /* x'' = g, up to the first order of the step: ODE's is 2 ms, the soft body's microseconds */
    check(fabs(height(cube) - (5 - moves * 9.81 * time * time / 2)) < 1e-3, "the cube falls");
    check(fabs(height(cube) - dBodyGetPosition(ball)[2]) < (moves ? 2e-3 : 1), "beside the ball");

    if (hook == dSoftHookThreading) { /* the application may take the way away, and is told */
        dWorldSetStepThreadingImplementation(world, NULL, NULL);
        check(soft.dSoftWorldGetHook_(soft_world) == dSoftHookNone, "a lost hook is told");
    }
    dWorldDestroy(world);
    soft.dSoftWorldDestroy_(soft_world); /* gone with its world, or just now */
    dSpaceDestroy(space);
    if (threads > 0) {
        dThreadingImplementationShutdownProcessing(threading);
        dThreadingFreeThreadPool(pool);
        dThreadingFreeImplementation(threading);
    }
    dCloseODE();
}

int main(int count, char** argument) {
    const char* mode = count > 1 ? argument[1] : "";
    const char* library = count > 2 ? argument[2] : NULL;
    const int flags = strstr(mode, "_global") ? RTLD_GLOBAL : RTLD_LOCAL;
    const dSoftHook hook = strncmp(mode, "interposed", 10) == 0 ? dSoftHookInterposed
                           : strncmp(mode, "threading", 9) == 0 ? dSoftHookThreading
                                                                : dSoftHookNone;
    for (int life = 0; life < 3; ++life)
        live(hook, library, flags, life % 2 ? dWorldQuickStep : dWorldStep, life == 2 ? 2 : 0);
    return failures != 0;
}
