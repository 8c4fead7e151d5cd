// A tolerance in cents chooses how a body is stepped; the choice is run and heard.
#include "support/ode_app.h"

#include <ode_softbody/softbody.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

namespace {

using namespace ode::soft;

std::string said;
void listen(int, const char* text, va_list arguments) {
    char line[512];
    std::vsnprintf(line, sizeof line, text, arguments);
    said += line;
}

class Tolerance : public testing::Test {
protected:
    Tolerance() {
        setenv("ODE_SOFTBODY_CACHE", "", 1);
        said.clear();
        dSetMessageHandler(listen);
        choice.struct_size = sizeof choice;
        dWorldSetGravity(app.world, 0, 0, 0);
    }
    ~Tolerance() override { dSetMessageHandler(nullptr); }

    static dSoftSolid steel() {
        dSoftSolid solid = dSoftSolidDefault();
        solid.phi = solid.psi = solid.alpha = solid.beta = solid.loss_factor = 0;
        return solid;
    }

    /// What a corner does after a blow askew, 40 ms of it [m/s].
    static std::vector<double> ring(dSoftWorldID world, dSoftBodyID body) {
        const dReal* velocity = nullptr;
        int stride = 0;
        dSoftBodyAddForceAtNode(body, 0, 0.3, 0.5, 0.4);
        std::vector<double> out;
        for (int n = 0; n < 2000; ++n) {
            dSoftWorldStep(world, kSpacing, dWorldStep);
            dSoftBodyGetVelocities(body, &velocity, &stride);
            out.push_back(velocity[0] + velocity[1] + velocity[2]);
        }
        return out;
    }

    /// The peak of the Hann-windowed transform near a guess [Hz], by ternary search.
    static double heard(const std::vector<double>& signal, double guess) {
        const auto level = [&](double f) {
            double re = 0, im = 0;
            for (std::size_t n = 0; n < signal.size(); ++n) {
                const double x = static_cast<double>(n) / static_cast<double>(signal.size());
                const double w = signal[n] * (1 - std::cos(2 * std::numbers::pi * x));
                const double phase = 2 * std::numbers::pi * f * kSpacing * static_cast<double>(n);
                re += w * std::cos(phase), im += w * std::sin(phase);
            }
            return std::hypot(re, im);
        };
        double a = guess - 40, b = guess + 40; // the window's main lobe is 100 Hz wide
        while (b - a > 1e-5 * guess) {
            const double third = (b - a) / 3;
            if (level(a + third) < level(b - third))
                a += third;
            else
                b -= third;
        }
        return 0.5 * (a + b);
    }

    static constexpr double kSpacing = 2e-5; // [s]
    ode::test::OdeApp app;
    dSoftChoice choice{};
};

// Reference: the corrected cubic modes, within their bands.
TEST_F(Tolerance, IsKeptByTheBodyThatWasChosen) {
    const MeshHandle mesh(dSoftMeshCreateBox(0.2, 0.05, 0.03, 10, 3, 2));
    const dSoftSolid solid = steel();
    const WorldHandle world(dSoftWorldCreate(app.world, app.space));
    const dSoftBodyID body = dSoftBodyCreate(world, mesh, &solid);
    ASSERT_EQ(dSoftBodySetTolerance(body, 60, &choice), 1) << said;
    EXPECT_EQ(choice.order, 2);
    EXPECT_STREQ(choice.integrator, "central-difference");
    EXPECT_STREQ(choice.material_model, "stvk");
    EXPECT_EQ(choice.order, dSoftBodyGetOrder(body));
    EXPECT_EQ(choice.substep, dSoftBodyGetSubstep(body));
    EXPECT_LE(choice.expected_cents, 60);

    dSoftModesOptions options = dSoftModesOptionsDefault();
    options.count = 9;
    options.max_frequency = dInfinity;
    options.rebuilt_curves = 0;
    const ModesHandle truth(dSoftModesCompute(mesh, &solid, 1, nullptr, 0, &options));
    const dReal* f = nullptr;
    ASSERT_EQ(dSoftModesGetFrequencies(truth, &f), 9);
    const std::vector<double> signal = ring(world, body);
    int told = 0;
    for (int k = 0; k < 8; ++k) {
        if (f[k + 1] - f[k] < 250 || (k > 0 && f[k] - f[k - 1] < 250))
            continue; // lines of 100 Hz width would lean on each other
        ++told;
        // What search and window leave is 0.2 cents.
        EXPECT_LT(std::abs(1200 * std::log2(heard(signal, f[k]) / f[k])),
                  choice.expected_cents + 0.2)
            << "partial " << k + 1 << ", " << f[k] << " Hz";
    }
    EXPECT_GE(told, 4);
}

TEST_F(Tolerance, GivesTheCheapestThatIsRightEnough) {
    const MeshHandle mesh(dSoftMeshCreateBox(0.1, 0.08, 0.06, 4, 3, 3));
    const dSoftSolid solid = steel();
    const WorldHandle world(dSoftWorldCreate(app.world, app.space));
    const dSoftBodyID body = dSoftBodyCreate(world, mesh, &solid);
    ASSERT_EQ(dSoftBodySetTolerance(body, 1000, &choice), 1) << said;
    EXPECT_EQ(choice.order, 1);
    const dReal rough = choice.expected_cents;
    ASSERT_EQ(dSoftBodySetTolerance(body, rough / 3, &choice), 1) << said;
    EXPECT_EQ(choice.order, 2);
    EXPECT_LE(choice.expected_cents, rough / 3);
}

TEST_F(Tolerance, OutOfReachIsToldWithTheEstimate) {
    const MeshHandle mesh(dSoftMeshCreateBar(0.3, 0.02, 0.01, 6, 1, 1));
    const dSoftSolid solid = steel();
    const WorldHandle world(dSoftWorldCreate(app.world, app.space));
    const dSoftBodyID body = dSoftBodyCreate(world, mesh, &solid);
    EXPECT_EQ(dSoftBodySetTolerance(body, 0.5, &choice), 0);
    EXPECT_GT(choice.expected_cents, 0.5);
    EXPECT_NE(said.find("finer mesh"), std::string::npos) << said;
    EXPECT_EQ(dSoftBodyGetOrder(body), 2);
    said.clear();
    EXPECT_EQ(dSoftBodySetTolerance(body, -1, nullptr), 0);
    EXPECT_NE(said.find("-1 cents"), std::string::npos) << said;
}

TEST_F(Tolerance, RubberGetsALawForLargeStrain) {
    const MeshHandle mesh(dSoftMeshCreateBox(0.1, 0.08, 0.06, 4, 3, 3));
    dSoftSolid solid = steel();
    solid.young = 1e6;
    solid.density = 1100;
    const WorldHandle world(dSoftWorldCreate(app.world, app.space));
    const dSoftBodyID body = dSoftBodyCreate(world, mesh, &solid);
    ASSERT_EQ(dSoftBodySetTolerance(body, 1000, &choice), 1) << said;
    EXPECT_STREQ(choice.material_model, "stable-neo-hookean");
}

} // namespace
