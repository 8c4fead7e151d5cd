#include "sink/first_error.h"

#include <gtest/gtest.h>
#include <string>

namespace ode::sound {
namespace {

TEST(FirstError, KeepsTheCauseAndNotItsConsequences) {
    FirstError error;
    EXPECT_STREQ(error.text(), "");
    error.set("%s after %d s", "disk full", 3);
    error.set("cannot close");
    EXPECT_STREQ(error.text(), "disk full after 3 s");
}

TEST(FirstError, CutsWhatIsTooLong) {
    FirstError error;
    error.set("%s", std::string(5000, 'x').c_str());
    EXPECT_GT(std::string(error.text()).size(), 500U);
    EXPECT_LT(std::string(error.text()).size(), 5000U);
}

} // namespace
} // namespace ode::sound
