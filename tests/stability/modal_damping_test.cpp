// Damping by modes beside every integrator, and of bodies that are nailed to a rigid one.
#include "stability/scene.h"

#include "integrate/modal_response.h"
#include "mesh/generate.h"
#include "modal/solve_modes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ode::test {
namespace {

using namespace ode::soft;

const Solid kSteel = solid_of(200e9, 0.29, 7850);
constexpr double kDecay = 60; ///< [1/s]

ModalModel modes_of(const Body& body, std::vector<int> held) {
    ModalOptions options;
    options.order = body.mesh().order;
    options.mass = MassKind::kLumped;
    options.estimate = false;
    options.max_modes = 1;
    options.clamped = std::move(held);
    return solve_modes(body.mesh(), body.solids(), options);
}

double amplitude(const Body& body, const ModalModel& modes) {
    double q = 0, rate = 0;
    for (std::size_t i = 0; i < body.mass().size(); ++i) {
        const Vec3 share = body.mass()[i] * modes.shape_at(0, i);
        q += share.dot(Vec3(body.state().position[i]) - body.mesh().node[i]);
        rate += share.dot(body.state().velocity[i]);
    }
    return std::hypot(2 * std::numbers::pi * modes.frequency[0] * q, rate);
}

void damp_all_modes(Body& body) {
    BodyForm form = body.form();
    const double t60 = std::log(1000.0) / kDecay;
    form.damping_table =
        DampingTable(std::vector<double>{100, 20000}, std::vector<double>{t60, t60});
    body.set_form(form);
}

void strike(Body& body, const ModalModel& modes) {
    std::size_t i = 0;
    set_velocities(body, [&](const Vec3&) { return Vec3(1e-5 * modes.shape_at(0, i++)); });
}

class DampedByModes : public testing::TestWithParam<const char*> {};

// The mode dies away by its own decay and by what the integrator itself takes, known from its code.
TEST_P(DampedByModes, DecaysAsTabulatedWhoeverSteps) {
    Scene scene;
    Body& bar = scene.add(make_bar(0.1, 0.02, 0.01, 5, 1, 1), kSteel, "stvk", 1, GetParam());
    damp_all_modes(bar);
    const ModalModel modes = modes_of(bar, {});
    if (!(bar.critical_step() < 1))
        bar.set_substep(5e-7);
    strike(bar, modes);
    const double before = amplitude(bar, modes);
    constexpr double kSeconds = 0.01;
    scene.run(kSeconds, 0.001);
    const double h = 0.001 / std::ceil(0.001 / bar.substep());
    const double own = ModalAnalysis(GetParam())
                           .response(2 * std::numbers::pi * modes.frequency[0] * h, 0)
                           .amplification;
    const double expected = std::exp(-kDecay * kSeconds) * std::pow(own, std::lround(kSeconds / h));
    EXPECT_NEAR(std::log(amplitude(bar, modes) / before), std::log(expected),
                0.01 * std::abs(std::log(expected)));
    EXPECT_EQ(bar.rollbacks(), 0);
}
INSTANTIATE_TEST_SUITE_P(Integrators, DampedByModes,
                         testing::Values("central-difference", "symplectic-euler", "runge-kutta-4",
                                         "backward-euler", "linearised-backward-euler",
                                         "trapezoidal", "tr-bdf2"));

// Nailed at one end to a body that doesn't move, or pinned there: the same modes, the same decay.
TEST(NailedBar, DecaysAsAPinnedOne) {
    double left[2];
    for (const bool nailed : {false, true}) {
        Scene scene;
        Body& bar = scene.add(make_bar(0.1, 0.02, 0.01, 5, 1, 1), kSteel);
        std::vector<int> end;
        for (std::size_t i = 0; i < bar.mesh().node.size(); ++i)
            if (bar.mesh().node[i].x() < 1e-9)
                end.push_back(static_cast<int>(i));
        damp_all_modes(bar);
        if (nailed) {
            const dBodyID wall = dBodyCreate(scene.world);
            dBodySetPosition(wall, 0, 0, 0);
            dBodySetKinematic(wall);
            scene.soft->attachments().attach(bar, wall, end);
        } else {
            bar.pin(end);
        }
        const ModalModel modes = modes_of(bar, end);
        strike(bar, modes);
        const double before = amplitude(bar, modes);
        scene.run(0.02, 0.001);
        left[nailed] = amplitude(bar, modes) / before;
        EXPECT_NEAR(left[nailed], std::exp(-kDecay * 0.02), 0.01 * left[nailed])
            << (scene.verdict().told.empty() ? "" : scene.verdict().told.front());
        EXPECT_EQ(bar.rollbacks(), 0);
    }
    EXPECT_NEAR(left[0], left[1], 1e-6);
}

} // namespace
} // namespace ode::test
