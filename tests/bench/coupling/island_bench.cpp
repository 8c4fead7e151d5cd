// Cost of a rigid body in a substep: its shadow when it is free, its twin and ODE's solver when it
// is jointed. Marks by a trial: 0.2 us free, 1.6 a hinge, 2.4 a chain of 4, 9.1 of 10.
#include "couple/rigid_shadow.h"

#include <benchmark/benchmark.h>
#include <ode/ode.h>

namespace {

using namespace ode::soft;

constexpr double kStep = 1e9; ///< of ODE: the substeps never end [s]
constexpr double kSubstep = 1e-5;

dBodyID add_ball(dWorldID world, double x) {
    const dBodyID body = dBodyCreate(world);
    dMass mass;
    dMassSetSphereTotal(&mass, 0.1, 0.01);
    dBodySetMass(body, &mass);
    dBodySetPosition(body, x, 0, 0);
    return body;
}

void BM_Free(benchmark::State& state) {
    dInitODE2(0);
    const dWorldID world = dWorldCreate();
    RigidShadow shadow(add_ball(world, 0), kStep, kSubstep);
    for (auto _ : state) {
        shadow.add({Vec3(0, 0, 0.1), Vec3::Zero()});
        shadow.advance(kSubstep);
    }
    dWorldDestroy(world);
    dCloseODE();
}
BENCHMARK(BM_Free);

/// @param arg  balls, hung on the world and on one another; one: by a hinge
void BM_Jointed(benchmark::State& state) {
    dInitODE2(0);
    const dWorldID world = dWorldCreate();
    const auto count = static_cast<int>(state.range(0));
    dBodyID before = nullptr;
    for (int i = 0; i < count; ++i) {
        const dBodyID ball = add_ball(world, 0.03 * i);
        const dJointID joint =
            count == 1 ? dJointCreateHinge(world, nullptr) : dJointCreateBall(world, nullptr);
        dJointAttach(joint, ball, before);
        if (count == 1)
            dJointSetHingeAnchor(joint, -0.015, 0, 0);
        else
            dJointSetBallAnchor(joint, 0.03 * i - 0.015, 0, 0);
        before = ball;
    }
    {
        MirrorWorld mirror;
        mirror.begin_step(world, 5e-3, kSubstep);
        for (dBodyID b = before; b;
             b = dJointGetBody(dBodyGetJoint(b, dBodyGetNumJoints(b) - 1), 1))
            mirror.include(b, false);
        mirror.build();
        RigidShadow shadow(*mirror.find(before), 5e-3);
        for (auto _ : state) {
            shadow.add({Vec3(0, 0, 0.1), Vec3::Zero()});
            shadow.advance(kSubstep);
            mirror.advance(kSubstep);
            shadow.follow();
        }
        state.counters["bodies"] = static_cast<double>(mirror.bodies().size());
    }
    dWorldDestroy(world);
    dCloseODE();
}
BENCHMARK(BM_Jointed)->Arg(1)->Arg(4)->Arg(10);

} // namespace

BENCHMARK_MAIN();
