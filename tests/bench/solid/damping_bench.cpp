// What damping costs a ringing body: CPU seconds for a simulated one without damping, by viscous
// stress and by modes, and how far the decay of its lowest mode is from what the law says.
#include "fma_peak.h"

#include "mesh/generate.h"
#include "modal/solve_modes.h"
#include "model/damping.h"
#include "model/materials.h"
#include "world/soft_world.h"

#include <benchmark/benchmark.h>
#include <ode/ode.h>

#include <algorithm>
#include <numbers>

namespace ode::soft {
namespace {

enum class Method { kNone, kStress, kModes };

/// Amplitude of velocity of the lowest mode, of a body that hasn't turned.
double amplitude(const Body& body, const ModalModel& modes) {
    double q = 0, rate = 0;
    for (std::size_t i = 0; i < body.mass().size(); ++i) {
        const Vec3 share = body.mass()[i] * modes.shape_at(0, i);
        q += share.dot(body.state().position[i] - body.mesh().node[i]);
        rate += share.dot(body.state().velocity[i]);
    }
    return std::hypot(2 * std::numbers::pi * modes.frequency[0] * q, rate);
}

void run(benchmark::State& state, int order, Method method) {
    setenv("ODE_SOFTBODY_CACHE", "", 1);
    dWorldID world = dWorldCreate();
    dSpaceID space = dSimpleSpaceCreate(nullptr);
    {
        // The bowl of the demo, in steel.
        Solid steel = find_material("steel")->solid;
        if (method == Method::kNone)
            steel.alpha = steel.beta = 0;
        SoftWorld soft(world, space);
        Body& body =
            soft.create_body(make_bowl(0.1, 0.005, std::numbers::pi / 2, 8, 24, 1), {&steel, 1});
        BodyForm form;
        form.order = order;
        form.modal_damping = method == Method::kModes;
        body.set_form(form);
        ModalOptions options;
        options.order = order;
        options.mass = MassKind::kLumped;
        options.estimate = false;
        options.max_modes = 1;
        const ModalModel modes = solve_modes(body.mesh(), body.solids(), options);
        for (std::size_t i = 0; i < body.mass().size(); ++i)
            body.add_force(static_cast<int>(i), 0.1 * body.mass()[i] * modes.shape_at(0, i));
        const double step = 0.2e-3;
        const auto free = [](dWorldID, dReal) { return 1; };
        double start = thread_seconds();
        soft.step(step, free);
        const double first = thread_seconds() - start;
        double st = 0, sy = 0, stt = 0, sty = 0, n = 0, t = 0, best = 1e300;
        for (auto _ : state) {
            start = thread_seconds();
            soft.step(step, free);
            const double seconds = thread_seconds() - start;
            state.SetIterationTime(seconds);
            best = std::min(best, seconds);
            const double y = std::log(amplitude(body, modes));
            t += step;
            st += t, sy += y, stt += t * t, sty += t * y, ++n;
        }
        const double decay = -(n * sty - st * sy) / (n * stt - st * st);
        const double expected = RayleighDamping{steel.alpha, steel.beta}.decay(modes.frequency[0]);
        state.counters["s/s"] = best / step;
        state.counters["substep_us"] = 1e6 * body.substep();
        state.counters["us/substep"] = 1e6 * best / std::ceil(step / body.substep());
        state.counters["decay_1/s"] = decay;
        state.counters["decay_error_%"] = expected > 0 ? 100 * (decay / expected - 1) : 0;
        state.counters["first_step_s"] = first;
    }
    dSpaceDestroy(space);
    dWorldDestroy(world);
}

} // namespace
} // namespace ode::soft

int main(int argc, char** argv) {
    using namespace ode::soft;
    dInitODE2(0);
    benchmark::Initialize(&argc, argv);
    const struct {
        const char* name;
        Method method;
    } methods[] = {{"none", Method::kNone}, {"stress", Method::kStress}, {"modes", Method::kModes}};
    for (const int order : {1, 2})
        for (const auto& m : methods)
            benchmark::RegisterBenchmark(
                (std::string("bowl/order_") + std::to_string(order) + "/" + m.name).c_str(),
                [=](benchmark::State& s) { run(s, order, m.method); })
                ->UseManualTime()
                ->Iterations(order == 1 ? 200 : 100);
    benchmark::RunSpecifiedBenchmarks();
    dCloseODE();
}
