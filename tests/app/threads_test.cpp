// The number of threads is nobody's business but the clock's.
#include "support/soft_app.h"

#include <ode_sound/sound.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <vector>

namespace {

using namespace ode;
using namespace ode::test;

struct Outcome {
    std::vector<dReal> place;
    std::vector<float> sample;
    bool operator==(const Outcome&) const = default;
};

/// Things of rubber that fall on a plane and are heard: a bar large enough to be cut in pieces, or
/// many cubes, some of them in their modes.
Outcome fall(bool many, const std::function<void(dSoftWorldID)>& set_threads) {
    OdeApp app(-9.81);
    soft::WorldHandle world(dSoftWorldCreate(app.world, app.space));
    set_threads(world);
    dCreatePlane(app.space, 0, 0, 1, 0);
    std::vector<dSoftBodyID> body;
    if (many) {
        for (int i = 0; i < 9; ++i) {
            body.push_back(add_cube(world, 0.1, 0, 4));
            dSoftBodySetPosition(body.back(), 0.2 * i, 0, 0.051);
            dSoftBodySetLinearVel(body.back(), 0, 0, -1);
            dSoftBodySetTier(body.back(), i % 3 == 0 ? "modal" : "explicit");
        }
    } else {
        const soft::MeshHandle mesh(dSoftMeshCreateBox(0.4, 0.1, 0.1, 24, 4, 4));
        const dSoftSolid rubber = soft_rubber();
        body.push_back(dSoftBodyCreate(world, mesh, &rubber));
        dSoftBodySetOrder(body.back(), 2);
        dSoftBodySetPosition(body.back(), 0, 0, 0.051);
        dSoftBodySetLinearVel(body.back(), 0, 0, -1);
    }
    sound::WorldHandle heard(dSoundWorldCreate(world));
    dSoundListenerID ears = dSoundListenerCreate(heard);
    dSoundListenerSetPosition(ears, 0, -1, 0);
    const sound::SinkHandle memory(dSoundSinkCreateMemory());
    dSoundListenerAddSink(ears, memory);
    for (int i = 0; i < 10; ++i)
        app.step(0.002);

    Outcome out;
    for (const dSoftBodyID b : body) {
        const dReal* first = nullptr;
        int stride = 0;
        const int nodes = dSoftBodyGetPositions(b, &first, &stride);
        out.place.insert(out.place.end(), first, first + nodes * stride);
    }
    const float* first = nullptr;
    int channels = 0;
    const unsigned long frames = dSoundSinkGetSamples(memory, &first, &channels);
    out.sample.assign(first, first + frames * static_cast<unsigned long>(channels));
    return out;
}

Outcome fall(bool many, int threads) {
    return fall(many, [=](dSoftWorldID world) {
        EXPECT_TRUE(dSoftWorldSetThreads(world, threads));
        EXPECT_EQ(dSoftWorldGetThreads(world), threads);
    });
}

TEST(Threads, GiveTheSameMotionAndSound) {
    for (const bool many : {false, true}) {
        const Outcome alone = fall(many, 1);
        EXPECT_FALSE(alone.sample.empty());
        for (const int threads : {2, 3})
            EXPECT_TRUE(fall(many, threads) == alone) << threads << " threads";
    }
}

/// Does the last part first, and the rest when it is waited for.
struct Backwards {
    struct Waiting {
        dSoftTask* task;
        void* context;
        int count;
    } waiting{};
    int jobs = 0;
    static void* enqueue(dSoftTask* task, void* context, int count, void* data) {
        auto& own = *static_cast<Backwards*>(data);
        ++own.jobs;
        own.waiting = {task, context, count - 1};
        task(context, count - 1);
        return &own.waiting;
    }
    static void finish(void* handle, void*) {
        const Waiting& w = *static_cast<Waiting*>(handle);
        for (int i = w.count - 1; i >= 0; --i)
            w.task(w.context, i);
    }
};

TEST(Threads, MayBeTheApplications) {
    for (const bool many : {false, true}) {
        Backwards backwards;
        const Outcome theirs = fall(many, [&](dSoftWorldID world) {
            EXPECT_TRUE(dSoftWorldSetTaskCallbacks(world, &Backwards::enqueue, &Backwards::finish,
                                                   &backwards));
            EXPECT_EQ(dSoftWorldGetThreads(world), 0);
        });
        EXPECT_GT(backwards.jobs, 50);
        EXPECT_TRUE(theirs == fall(many, 1));
    }
}

TEST(Threads, BadOnesAreTold) {
    OdeApp app;
    soft::WorldHandle world(dSoftWorldCreate(app.world, app.space));
    Messages messages;
    for (const int bad : {-1, 65})
        EXPECT_EQ(dSoftWorldSetThreads(world, bad), 0);
    EXPECT_EQ(Messages::with("give 1 to 64"), 2) << Messages::text();
    EXPECT_EQ(dSoftWorldSetTaskCallbacks(world, &Backwards::enqueue, nullptr, nullptr), 0);
    EXPECT_EQ(Messages::with("finish is missing"), 1) << Messages::text();
    EXPECT_EQ(dSoftWorldGetThreads(world), 1);
    EXPECT_EQ(dSoftWorldSetThreads(world, 0), 1);
    EXPECT_GE(dSoftWorldGetThreads(world), 1);
}

} // namespace
