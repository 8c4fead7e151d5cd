// Accuracy case A12: one mode of a free steel bar dies away by T60 = 6.908 / d, d = (alpha + beta
// w^2) / 2.
#include "mesh/generate.h"
#include "modal/solve_modes.h"
#include "model/damping.h"
#include "world/soft_world.h"

#include <gtest/gtest.h>
#include <ode/ode.h>

#include <numbers>

namespace ode::soft {
namespace {

/// Amplitude of one mode, from mass-normalised displacement q and its rate.
struct ModeWatch {
    const Body& body;
    const ModalModel& modes;
    std::size_t mode;

    double amplitude() const {
        const double w = 2 * std::numbers::pi * modes.frequency[mode];
        double q = 0, rate = 0;
        for (std::size_t i = 0; i < body.mass().size(); ++i) {
            const Vec3 share = body.mass()[i] * modes.shape_at(mode, i);
            q += share.dot(body.state().position[i] - body.mesh().node[i]);
            rate += share.dot(body.state().velocity[i]);
        }
        return std::hypot(w * q, rate);
    }
};

/// T60 [s] of the lowest mode, struck by the force of its own shape and left alone.
void rings_down_as_predicted(int order, double alpha, double beta) {
    dInitODE2(0);
    dWorldID world = dWorldCreate();
    dSpaceID space = dSimpleSpaceCreate(nullptr);
    {
        Solid steel;
        steel.young = 200e9;
        steel.poisson = 0.29;
        steel.density = 7850;
        steel.alpha = alpha;
        steel.beta = beta;
        SoftWorld soft(world, space);
        Body& body = soft.create_body(make_bar(0.1, 0.02, 0.01, 5, 1, 1), {&steel, 1});
        body.set_form({order, "stvk", false});
        ModalOptions options;
        options.order = order;
        options.mass = MassKind::kLumped;
        options.estimate = false;
        options.max_modes = 2;
        const ModalModel modes = solve_modes(body.mesh(), body.solids(), options);
        const double f = modes.frequency[0];
        const double t60 = t60_of_decay(RayleighDamping{alpha, beta}.decay(f));
        // The free bar bends 1e-8 m, far inside the linear range.
        for (std::size_t i = 0; i < body.mass().size(); ++i)
            body.add_force(static_cast<int>(i), 0.1 * body.mass()[i] * modes.shape_at(0, i));
        const double step = 0.2 / f;
        soft.step(step, dWorldStep);
        const ModeWatch watch{body, modes, 0};
        // Least squares of ln a over the first 20 dB; a ripples at 2 f by about w dt / 2, the
        // velocity's half substep, which a hundred periods wash out.
        double st = 0, sy = 0, stt = 0, sty = 0;
        int n = 0;
        for (double t = 0; t < t60 / 3; t += step, ++n) {
            const double y = std::log(watch.amplitude());
            st += t, sy += y, stt += t * t, sty += t * y;
            soft.step(step, dWorldStep);
        }
        ASSERT_FALSE(body.stopped());
        ASSERT_GT(n, 300);
        const double decay = -(n * sty - st * sy) / (n * stt - st * st);
        EXPECT_NEAR(t60_of_decay(decay), t60, 0.01 * t60)
            << "order " << order << ", " << f << " Hz";
    }
    dSpaceDestroy(space);
    dWorldDestroy(world);
    dCloseODE();
}

TEST(Decay, OfMassProportionalDampingIsWithinOnePercent) { rings_down_as_predicted(1, 300, 0); }

TEST(Decay, OfStiffnessProportionalDampingIsWithinOnePercent) {
    rings_down_as_predicted(1, 0, 1.5e-7);
}

TEST(Decay, OfRayleighDampingIsWithinOnePercentInQuadraticElements) {
    rings_down_as_predicted(2, 150, 1.5e-7);
}

} // namespace
} // namespace ode::soft
