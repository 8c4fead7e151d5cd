// The instability alarm through the public functions: raised for a body whose integrator is
// unstable, counted, told and handed to a callback; silent for the same body under a stable one,
// struck.
#include "support/ode_app.h"

#include <ode_sound/sound.hpp>

#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>

namespace {

using namespace ode;

int messages = 0;
void hear(int, const char* text, va_list) {
    messages += std::strncmp(text, "instability alarm", 17) == 0;
}

struct Raised {
    dSoftBodyID body = nullptr;
    dReal time = 0;
    int times = 0;
};
void on_alarm(void* data, dSoftBodyID body, dReal time) {
    auto& raised = *static_cast<Raised*>(data);
    raised = {body, time, raised.times + 1};
}

struct Dropped {
    Raised raised;
    dSoundStats stats{};
    dSoftBodyID body;
};

Dropped drop(const char* integrator) {
    messages = 0;
    test::OdeApp app(-9.81);
    dSetMessageHandler(&hear);
    dCreatePlane(app.space, 0, 0, 1, 0);
    const soft::WorldHandle soft(dSoftWorldCreate(app.world, app.space));
    const soft::MeshHandle mesh(dSoftMeshCreateBox(0.1, 0.1, 0.1, 2, 2, 2));
    dSoftSolid rubber = dSoftSolidDefault();
    rubber.young = 1e6;
    rubber.density = 1000;
    Dropped run{};
    run.body = dSoftBodyCreate(soft, mesh, &rubber);
    dSoftBodySetPosition(run.body, 0, 0, 0.051);
    dSoftBodySetLinearVel(run.body, 0, 0, -2);
    dSoftBodySetIntegrator(run.body, integrator);
    const sound::WorldHandle world(dSoundWorldCreate(soft));
    dSoundListenerCreate(world);
    dSoundSetAlarm(world, &on_alarm, &run.raised);
    for (int i = 0; i < 120; ++i)
        app.step(1.0 / 240);
    run.stats.struct_size = sizeof run.stats;
    dSoundGetStats(world, &run.stats);
    dSetMessageHandler(nullptr);
    return run;
}

TEST(Alarm, IsRaisedForABodyWhoseIntegratorIsUnstable) {
    const Dropped run = drop("explicit-euler");
    EXPECT_EQ(run.stats.alarms, 1u);
    EXPECT_EQ(run.raised.times, 1);
    EXPECT_EQ(run.raised.body, run.body);
    EXPECT_GT(run.raised.time, 0);
    EXPECT_EQ(run.raised.time, run.stats.alarm_time);
    EXPECT_EQ(messages, 1);
}

TEST(Alarm, IsSilentForABodyThatStrikesTheFloor) {
    const Dropped run = drop("central-difference");
    EXPECT_EQ(run.stats.alarms, 0u);
    EXPECT_EQ(run.stats.alarm_time, 0);
    EXPECT_EQ(run.raised.times, 0);
    EXPECT_EQ(messages, 0);
    EXPECT_GT(run.stats.peak, 1e-3) << "it was heard";
}

} // namespace
