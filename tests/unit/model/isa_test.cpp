#include "base/isa.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace ode::soft {
namespace {

/// The choice is made once a process: each case runs in a process of its own, whose exit code says
/// what was chosen.
[[noreturn]] void choose_with(const char* wanted) {
    setenv("ODE_SOFTBODY_ISA", wanted, 1);
    std::exit(10 + static_cast<int>(active_isa()));
}

int code(Isa isa) { return 10 + static_cast<int>(isa); }

Isa best() {
    return is_supported(Isa::avx512) ? Isa::avx512
           : is_supported(Isa::avx2) ? Isa::avx2
                                     : Isa::baseline;
}

TEST(IsaDeathTest, EnvironmentPinsTheChoice) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_TRUE(is_supported(Isa::baseline));
    for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512})
        EXPECT_EXIT(choose_with(isa_name(isa)),
                    testing::ExitedWithCode(code(is_supported(isa) ? isa : best())), "");
}

TEST(IsaDeathTest, AnUnknownNameIsReportedAndTheBestTaken) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(choose_with("avx1024"), testing::ExitedWithCode(code(best())),
                "ODE_SOFTBODY_ISA is 'avx1024'");
}

} // namespace
} // namespace ode::soft
