#include "mix/cpu_clock.h"

#include <gtest/gtest.h>

namespace ode::sound {
namespace {

double cpu = 0.0, wall = 0.0;
double read_cpu() noexcept { return cpu; }
double read_wall() noexcept { return wall; }

void work(double seconds) {
    cpu += seconds;
    wall += seconds;
}

// One job in 31 stands for all; what happens once, whichever job it falls into, counts once.
TEST(SampledCost, CountsWhatComesOnceOnce) {
    for (const double each : {1e-6, 1e-3}) // by the wall's clock, by the thread's
        for (int when = 0; when < 62; ++when) {
            SampledCost cost(read_cpu, read_wall);
            for (int job = 0; job < 62; ++job)
                cost.run([&] {
                    work(each);
                    if (job != when)
                        return;
                    const int result = cost.run_once([] {
                        work(4.0);
                        return 7;
                    });
                    EXPECT_EQ(result, 7);
                });
            // A long job is told by the first one measured, which then isn't counted.
            EXPECT_NEAR(cost.seconds(), 4.0 + 62 * each, 31.5 * each) << each << ", " << when;
        }
}

// Another process has the core for a while: that is no cost of ours.
TEST(SampledCost, DoesNotCountInterruptions) {
    SampledCost cost(read_cpu, read_wall);
    constexpr int kJobs = 31 * 1000;
    for (int job = 1; job <= kJobs; ++job)
        cost.run([&] {
            work(1e-6);
            if (job % (31 * 10) == 0)
                wall += 4e-3;
        });
    EXPECT_NEAR(cost.seconds() / (kJobs * 1e-6), 1.0, 0.01);
}

// Every sixteenth job is a long one: it is met in proportion.
TEST(SampledCost, CountsRareLongJobs) {
    SampledCost cost(read_cpu, read_wall);
    constexpr int kJobs = 31 * 2000;
    double all = 0.0;
    for (int job = 1; job <= kJobs; ++job)
        cost.run([&] {
            const double each = job % 16 == 0 ? 3e-4 : 1e-6;
            work(each);
            all += each;
        });
    EXPECT_NEAR(cost.seconds() / all, 1.0, 0.05);
}

} // namespace
} // namespace ode::sound
