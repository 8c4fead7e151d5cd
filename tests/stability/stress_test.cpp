// The quick cases of the stress suite, one test each. `softsound bench stability` prints all.
#include "stability/suite.h"

#include <gtest/gtest.h>

#include <cctype>
#include <iostream>

namespace ode::test {
namespace {

std::vector<StressCase> quick_cases() {
    std::vector<StressCase> quick = stress_cases();
    std::erase_if(quick, [](const StressCase& c) { return !c.quick; });
    return quick;
}

/// Grouped, so that ctest lists groups and not hundreds of entries.
class Stress : public testing::TestWithParam<std::string> {};

TEST_P(Stress, EndsAsTheSuiteAsks) {
    for (const StressCase& c : quick_cases()) {
        if (c.group != GetParam())
            continue;
        const StressResult result = c.run();
        EXPECT_TRUE(result.good) << c.group << ": " << c.name << ": " << result.outcome << "; "
                                 << result.figure;
    }
}

std::vector<std::string> groups() {
    std::vector<std::string> names;
    for (const StressCase& c : quick_cases())
        if (names.empty() || names.back() != c.group)
            names.push_back(c.group);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Suite, Stress, testing::ValuesIn(groups()), [](const auto& instance) {
    std::string name;
    for (const char c : instance.param)
        name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    return name;
});

} // namespace
} // namespace ode::test
