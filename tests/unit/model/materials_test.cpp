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

double loss_at(const char* name, double f) {
    const Solid& s = find_material(name)->solid;
    return loss_factor_of_decay(RayleighDamping{s.alpha, s.beta}.decay(f), f);
}

TEST(Materials, DampingIsWhatTheSourceFieldSays) {
    const double brass = std::sqrt(2e-4 * 1e-3);
    EXPECT_NEAR(loss_at("brass", 1000), brass, 0.01 * brass);
    EXPECT_NEAR(loss_at("bronze", 1000), brass, 0.01 * brass);
    EXPECT_NEAR(loss_at("copper", 1000), 2e-3, 0.01 * 2e-3);
    EXPECT_NEAR(loss_at("rubber", 100), 2 * 0.05, 0.001);
    EXPECT_NEAR(loss_at("rubber", 1000), 2 * 0.05, 0.001);
}

// G = E / 2 (1 + nu) of the nearly incompressible preset stays within a per cent of the source's.
TEST(Materials, RubberHasTheShearModulusOfItsSource) {
    EXPECT_NEAR(find_material("rubber")->solid.mu(), 0.5e6, 0.01 * 0.5e6);
}

} // namespace
} // namespace ode::soft
