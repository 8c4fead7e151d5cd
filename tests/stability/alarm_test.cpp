// The instability alarm over the stress suite: raised in every case whose world has to take a body
// back or to stop it, while its energy is still below ten times what is due; silent in all others.
#include "stability/suite.h"

#include "mix/alarm.h"
#include "mix/scene.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <optional>

namespace ode::test {
namespace {

using soft::Body;

/// What came of one case.
struct Report {
    bool unstable = false;
    unsigned long raised = 0, heard = 0;
    double most = 0; ///< energy over what is due, at the ends of steps before the alarm
};

/// Listens as a sound world does, and looks at the energy that a world is left with.
class Ears final : public soft::Observer {
public:
    Ears() { scene_.add_listener(0); }

    bool wants_substeps() const noexcept override { return true; }
    void on_substep(const soft::SubstepView& view) noexcept override {
        const Body& body = view.body;
        const auto& triangle = body.surface().triangle;
        const auto& state = body.state();
        scene_.push(&body, {triangle.data()->data(), 3 * triangle.size()},
                    {view.time, view.dt, state.position.data(), state.velocity.data(), 4});
    }
    void on_step(soft::SoftWorld& world, double time) noexcept override {
        scene_.end_step(time);
        for (const auto& body : world.bodies()) {
            seen_.unstable |= body->rollbacks() > 0 || body->stopped();
            if (alarm_.count() == 0 && !body->stopped() && body->budget().budget() > 0)
                seen_.most =
                    std::fmax(seen_.most, body->budget().energy() / body->budget().budget());
        }
        alarm_.update(
            scene_, time,
            [](const void* key) {
                const Body& body = *static_cast<const Body*>(key);
                return sound::Alarm::Fare{body.rollbacks(), body.stopped()};
            },
            [&](const void*, double, sound::Alarm::Cause cause) {
                seen_.heard += cause == sound::Alarm::Cause::kHeard;
            });
        seen_.raised = alarm_.count();
    }
    void on_body_end(Body& body) noexcept override {
        alarm_.forget(&body);
        scene_.end_body(&body);
    }
    void on_world_end(soft::SoftWorld&) noexcept override { last = seen_; }

    static inline Report last;

private:
    Report seen_;
    sound::Scene scene_;
    sound::Alarm alarm_;
};

TEST(Alarm, IsRaisedInUnstableCasesAloneAndBeforeEnergyHasGrownTenfold) {
    Scene::on_create = [](Scene& scene) { scene.soft->add_observer(std::make_unique<Ears>()); };
    int unstable = 0, stable = 0, heard = 0;
    for (const StressCase& c : stress_cases()) {
        if (!c.quick || c.group == "critical step" || c.group == "rest") // nothing moves; minutes
            continue;
        Ears::last = {};
        c.run();
        const Report& seen = Ears::last;
        (seen.unstable ? unstable : stable) += 1;
        heard += seen.heard > 0;
        EXPECT_EQ(seen.raised > 0, seen.unstable) << c.group << ": " << c.name;
        if (seen.unstable) {
            EXPECT_LT(seen.most, 10) << c.group << ": " << c.name;
        }
    }
    Scene::on_create = nullptr;
    std::printf("alarm raised in %d unstable cases (by ear in %d), silent in %d stable ones\n",
                unstable, heard, stable);
    EXPECT_GT(unstable, 20);
    EXPECT_GT(stable, 80);
}

} // namespace
} // namespace ode::test
