#include "model/materials.h"

#include "model/check_solid.h"
#include "model/damping.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace ode::soft {
namespace {

TEST(Materials, EveryPresetIsAStableSolidThatRingsDownAndNamesItsSource) {
    std::set<std::string> names;
    for (const Material& m : materials()) {
        EXPECT_NO_THROW(check_solid(m.solid)) << m.name;
        EXPECT_GT(m.solid.alpha + m.solid.beta, 0) << m.name;
        EXPECT_GT(std::string(m.source).size(), 10u) << m.name;
        EXPECT_TRUE(names.insert(m.name).second) << m.name;
        EXPECT_EQ(find_material(m.name), &m);
    }
    for (const char* name : {"steel", "aluminium", "brass", "bronze", "iron", "glass", "ceramic",
                             "wood", "plastic", "rubber", "copper"})
        EXPECT_TRUE(names.count(name)) << name;
}

double loss_at_1khz(const char* name) {
    const Solid& s = find_material(name)->solid;
    return loss_factor_of_decay(RayleighDamping{s.alpha, s.beta}.decay(1000), 1000);
}

TEST(Materials, DampingIsWhatTheSourceFieldSays) {
    EXPECT_NEAR(loss_at_1khz("brass"), std::sqrt(2e-4 * 1e-3), 0.01 * std::sqrt(2e-4 * 1e-3));
    EXPECT_NEAR(loss_at_1khz("copper"), 2e-3, 0.01 * 2e-3);
    const auto t60 = [](const char* name, double f) {
        const Solid& s = find_material(name)->solid;
        return t60_of_decay(RayleighDamping{s.alpha, s.beta}.decay(f));
    };
    EXPECT_NEAR(t60("bronze", 1000), 5, 0.05);
    EXPECT_NEAR(t60("rubber", 100), 0.22, 0.005);
    EXPECT_NEAR(t60("rubber", 1000), 0.03, 0.001);
}

} // namespace
} // namespace ode::soft
