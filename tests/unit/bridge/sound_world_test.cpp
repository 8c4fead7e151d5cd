// The soft world here is the test's own: these functions stand in for libode_softbody's, so
// that registration and the order of ends can be seen from outside.
#include "bridge/sound_world.h"
#include "physics/sound/rig.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace {

struct FakeWorld {
    std::optional<dSoftObserver> observer;
    int added = 0;
    int removed = 0;
    std::string tier = "explicit";
};
FakeWorld fake;
int world_handle;
int body_handle;

dSoftWorldID world_id() { return reinterpret_cast<dSoftWorldID>(&world_handle); }
dSoftBodyID body_id() { return reinterpret_cast<dSoftBodyID>(&body_handle); }

} // namespace

int dSoftWorldAddObserver(dSoftWorldID, const dSoftObserver* observer) {
    fake.observer = *observer;
    ++fake.added;
    return 1;
}
int dSoftWorldRemoveObserver(dSoftWorldID, void* data) {
    EXPECT_TRUE(fake.observer && fake.observer->data == data);
    fake.observer.reset();
    ++fake.removed;
    return 1;
}
dReal dSoftWorldGetTime(dSoftWorldID) { return 0.0; }
int dSoftBodyGetModalBasis(dSoftBodyID, dSoftModalBasis*) { return 0; }
int dSoftBodyGetStatus(dSoftBodyID, dSoftStatus*) { return 0; }
int dSoftBodySetTier(dSoftBodyID, const char* name) {
    fake.tier = name;
    return 1;
}
const char* dSoftBodyGetTier(dSoftBodyID) { return fake.tier.c_str(); }
int dSoftBodyGetTriangles(dSoftBodyID, const int**) { return 0; }

namespace ode::sound::test {
namespace {

/// Steps a pulsating sphere and calls the observer as the soft world does.
class Body {
public:
    explicit Body(int stride) : stride_(stride) {}

    void step(double seconds) {
        const double dt = 2e-6;
        const auto n = shape_.node.size();
        const auto stride = static_cast<std::size_t>(stride_);
        std::vector<double> x(stride * n, std::nan("")), v(stride * n, std::nan(""));
        const double end = time_ + seconds;
        while (time_ < end - 0.5 * dt) {
            time_ += dt;
            const double w = 3000.0;
            for (std::size_t i = 0; i < n; ++i)
                for (std::size_t k = 0; k < 3; ++k) {
                    const double r = 0.01 * shape_.node[i][static_cast<Eigen::Index>(k)];
                    x[stride * i + k] = r * (1.0 + 1e-3 * std::sin(w * time_));
                    v[stride * i + k] = r * 1e-3 * w * std::cos(w * (time_ - 0.5 * dt));
                }
            if (!fake.observer)
                continue;
            dSoftSubstep substep{};
            substep.struct_size = sizeof substep;
            substep.body = body_id();
            substep.time = time_;
            substep.dt = dt;
            substep.position = x.data();
            substep.velocity = v.data();
            substep.stride = stride_;
            substep.node_count = static_cast<int>(n);
            substep.triangle = shape_.triangle.data();
            substep.triangle_count = static_cast<int>(shape_.triangle.size() / 3);
            fake.observer->on_substep(fake.observer->data, &substep);
        }
        if (fake.observer)
            fake.observer->on_step(fake.observer->data, world_id(), time_);
    }

private:
    Shape shape_ = make_sphere(1);
    int stride_;
    double time_ = 0.0;
};

class SoundWorldTest : public testing::Test {
protected:
    void SetUp() override { fake = FakeWorld{}; }
};

// Underruns lower the tiers of what sounds, in two stages half a second apart; "stretch" gives
// back.
TEST_F(SoundWorldTest, PacePolicyDropsTiersAndGivesThemBack) {
    SoundWorld world(world_id());
    Body body(4);
    world.add_listener();
    body.step(0.01);
    Pace pace;
    pace.update(world.scene(), 1, 0.0);
    EXPECT_EQ(fake.tier, "explicit") << "stretch is the default";
    pace.set(Pace::Policy::kDropQuality);
    pace.update(world.scene(), 1, 0.1);
    EXPECT_EQ(fake.tier, "explicit") << "no underrun since";
    pace.update(world.scene(), 2, 0.2);
    EXPECT_EQ(fake.tier, "auto");
    pace.update(world.scene(), 3, 0.5);
    EXPECT_EQ(fake.tier, "auto") << "it has had no time to show";
    pace.update(world.scene(), 3, 1.5);
    EXPECT_EQ(fake.tier, "auto") << "it helped";
    pace.update(world.scene(), 4, 2.0);
    EXPECT_EQ(fake.tier, "modal");
    pace.update(world.scene(), 5, 9.0);
    EXPECT_EQ(pace.stage(), 2) << "nothing is left to drop";
    pace.set(Pace::Policy::kStretch);
    EXPECT_EQ(fake.tier, "explicit");
}

TEST_F(SoundWorldTest, WithoutListenerNothingIsObserved) {
    SoundWorld world(world_id());
    Body body(4);
    body.step(0.01);
    EXPECT_EQ(fake.added, 0);
    EXPECT_EQ(world.scene().count().substeps, 0u);
    Listener& first = world.add_listener();
    Listener& second = world.add_listener();
    EXPECT_EQ(fake.added, 1) << "one observer serves all listeners";
    body.step(0.01);
    EXPECT_EQ(world.scene().count().substeps, 5000u);
    world.remove_listener(first);
    EXPECT_EQ(fake.removed, 0);
    world.remove_listener(second);
    EXPECT_EQ(fake.removed, 1);
    body.step(0.01);
    EXPECT_EQ(world.scene().count().substeps, 5000u);
    EXPECT_GT(world.seconds(), 0.0);
}

TEST_F(SoundWorldTest, PackedAndPaddedNodesSoundTheSame) {
    std::vector<double> heard[2];
    for (const int stride : {3, 4}) {
        const auto recorder = std::make_shared<Recorder>();
        SoundWorld world(world_id());
        Listener& listener = world.add_listener();
        listener.pose.centre = {0.0, 0.1, 0.0};
        listener.add_sink(recorder);
        Body(stride).step(0.02);
        heard[stride - 3] = recorder->ear[0];
        EXPECT_GT(world.scene().count().peak, 0.0);
    }
    EXPECT_EQ(heard[0], heard[1]);
}

TEST_F(SoundWorldTest, SurvivesTheSoftWorldAndPlaysOut) {
    const auto recorder = std::make_shared<Recorder>();
    {
        SoundWorld world(world_id());
        Listener& listener = world.add_listener();
        listener.pose.centre = {0.0, 34.3, 0.0}; // 0.1 s
        listener.add_sink(recorder);
        Body body(4);
        body.step(0.02);
        const dSoftObserver observer = *fake.observer;
        observer.on_world_end(observer.data, world_id());
        EXPECT_GT(recorder->ear[0].size(), 5760u) << "0.12 s: all that travelled";
        observer.on_body_end(observer.data, body_id()); // in either order
        world.remove_listener(listener);
        EXPECT_EQ(fake.removed, 0) << "the soft world is gone: it is not called";
        world.add_listener();
        EXPECT_EQ(fake.added, 1);
    }
    EXPECT_EQ(fake.removed, 0);
}

TEST_F(SoundWorldTest, BodyMayEndBeforeTheWorld) {
    SoundWorld world(world_id());
    world.add_listener().pose.centre = {0.0, 0.1, 0.0};
    Body body(4);
    body.step(0.02);
    fake.observer->on_body_end(fake.observer->data, body_id());
    fake.observer->on_step(fake.observer->data, world_id(), 0.03);
    fake.observer->on_step(fake.observer->data, world_id(), 0.04);
    Body again(4); // another body at the same address
    again.step(0.02);
    EXPECT_GT(world.scene().count().peak, 0.0);
}

} // namespace
} // namespace ode::sound::test
