#include "model/check_solid.h"

#include "base/error.h"

#include <gmock/gmock.h>

#include <cmath>

namespace ode::soft {
namespace {

Solid steel() { return {.young = 200e9, .poisson = 0.29, .density = 7850}; }

std::string refusal(const Solid& solid, const std::string& group = {}) {
    try {
        check_solid(solid, group);
    } catch (const InputError& e) {
        return e.what();
    }
    return "";
}

TEST(CheckSolid, AcceptsWhatSolidsAreMadeOf) {
    EXPECT_EQ(refusal(steel()), "");
    Solid auxetic = steel();
    auxetic.poisson = -0.9;
    EXPECT_EQ(refusal(auxetic), "");
}

TEST(CheckSolid, NamesTheConstantItsValueAndTheCure) {
    using testing::HasSubstr;
    const auto with = [](double Solid::*field, double value) {
        Solid solid = steel();
        solid.*field = value;
        return refusal(solid, "rim");
    };
    EXPECT_THAT(with(&Solid::young, -1), HasSubstr("Young's modulus of group 'rim' is -1 Pa"));
    EXPECT_THAT(with(&Solid::density, 0), HasSubstr("such as 7850"));
    EXPECT_THAT(with(&Solid::poisson, 0.5), HasSubstr("for rubber take 0.49"));
    for (double Solid::*field : {&Solid::phi, &Solid::psi, &Solid::alpha, &Solid::beta})
        EXPECT_THAT(with(field, -1e-9), HasSubstr("not be negative"));
    for (double Solid::*field : {&Solid::young, &Solid::poisson, &Solid::density, &Solid::beta})
        EXPECT_NE(with(field, std::nan("")), "");
}

} // namespace
} // namespace ode::soft
