#include "base/error.h"

#include <gtest/gtest.h>

#include <ode/error.h>

namespace ode::soft {
namespace {

std::string heard;

void hear(int, const char* text, va_list arguments) {
    char line[256];
    std::vsnprintf(line, sizeof line, text, arguments);
    heard = line;
}

TEST(Error, FormatsLikePrintf) {
    EXPECT_EQ(format("%s:%d: %.2f", "bowl.msh", 7, 0.5), "bowl.msh:7: 0.50");
    EXPECT_EQ(format("%s", ""), "");
}

// A sentence may hold a percent sign of the user's: it must not be read as a format again.
TEST(Error, ReportReachesTheApplicationsHandlerUnchanged) {
    dSetMessageHandler(hear);
    report("mesh '100%s.msh' has no tetrahedra");
    dSetMessageHandler(nullptr);
    EXPECT_EQ(heard, "mesh '100%s.msh' has no tetrahedra");
}

} // namespace
} // namespace ode::soft
