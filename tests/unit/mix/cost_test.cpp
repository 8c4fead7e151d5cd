#include "mix/cpu_clock.h"

#include <gtest/gtest.h>

namespace ode::sound {
namespace {

double now = 0.0;
double read_now() noexcept { return now; }

// One job in 31 stands for all; what happens once, whichever job it falls into, counts once.
TEST(SampledCost, CountsWhatComesOnceOnce) {
    for (int when = 0; when < 31; ++when) {
        SampledCost cost(read_now);
        for (int job = 0; job < 31; ++job)
            cost.run([&] {
                now += 1.0;
                if (job != when)
                    return;
                const int result = cost.run_once([] {
                    now += 4000.0;
                    return 7;
                });
                EXPECT_EQ(result, 7);
            });
        EXPECT_DOUBLE_EQ(cost.seconds(), 4031.0) << when;
    }
}

} // namespace
} // namespace ode::sound
