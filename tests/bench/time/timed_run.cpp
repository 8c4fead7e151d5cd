#include "bench/time/timed_run.h"

#include "integrate/critical_step.h"
#include "integrate/integrator.h"
#include "mesh/promote.h"
#include "model/make_model.h"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace ode::soft {
namespace {

double cpu_time() {
    timespec now = {};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A body under one method, no force on it but its own.
class Motion {
public:
    Motion(const ElasticModel& model, const TimeScene& scene, const TetMesh& mesh,
           const std::string& integrator)
        : model_(model), state_{NodeArray(model.node_count()), NodeArray(model.node_count())},
          force_(model.node_count()),
          method_(integrator_kind(integrator).make(model.node_count())) {
        for (const double mass : model.mass())
            inverse_mass_.push_back(1 / mass);
        for (std::size_t i = 0; i < mesh.node.size(); ++i) {
            state_.position[i] = mesh.node[i];
            state_.velocity[i] = scene.start[i];
        }
    }

    /// @return whether all is well.
    bool go(double h, long steps) {
        const NodeInertia inertia{inverse_mass_};
        force_.set_zero();
        method_->begin(model_, inertia, h, state_, force_);
        for (long n = 0; n < steps; ++n) {
            force_.set_zero();
            const double before = method_->evaluate(model_, state_, force_).max_stretch;
            const double after = method_->step(model_, inertia, h, state_, force_).max_stretch;
            if (!(before < kTorn) || !(after < kTorn))
                return false;
        }
        force_.set_zero();
        method_->end(model_, inertia, h, state_, force_);
        return true;
    }

    const NodeState& state() const { return state_; }

private:
    static constexpr double kTorn = 10; ///< stretch of a body that blew up

    const ElasticModel& model_;
    std::vector<double> inverse_mass_;
    NodeState state_;
    NodeArray force_;
    std::unique_ptr<Integrator> method_;
};

} // namespace

TimedRun run(const TimeScene& scene, const Method& method, double budget) {
    const TetMesh mesh = method.order == 2 ? promote_to_quadratic(scene.mesh) : scene.mesh;
    const auto model = make_model(scene.model, mesh, {&scene.solid, 1});
    std::vector<double> inverse_mass;
    for (const double mass : model->mass())
        inverse_mass.push_back(1 / mass);
    NodeArray rest(mesh.node.size());
    for (std::size_t i = 0; i < mesh.node.size(); ++i)
        rest[i] = mesh.node[i];
    const double critical = critical_step(*model, inverse_mass, rest, viscous_time(scene.solid));

    TimedRun out;
    const double between = scene.duration / scene.samples;
    const auto steps = static_cast<long>(std::ceil(between / (method.share * critical)));
    out.step = between / static_cast<double>(steps);
    {
        Motion trial(*model, scene, mesh, method.integrator);
        trial.go(out.step, 1); // scratch is made
        const double start = cpu_time();
        long n = 0;
        do
            trial.go(out.step, 1), ++n;
        while (cpu_time() - start < 0.02 && n < 20);
        out.cpu = (cpu_time() - start) / (static_cast<double>(n) * out.step);
    }
    out.within_budget = out.cpu * scene.duration <= budget;
    if (!out.within_budget)
        return out;
    Motion motion(*model, scene, mesh, method.integrator);
    double spent = 0;
    for (int n = 0; n < scene.samples && out.stable; ++n) {
        const double start = cpu_time();
        out.stable = motion.go(out.step, steps);
        spent += cpu_time() - start;
        std::vector<Vec3> sample(scene.mesh.node.size());
        for (std::size_t i = 0; i < sample.size(); ++i)
            sample[i] = motion.state().velocity[i];
        out.waveform.push_back(std::move(sample));
    }
    out.cpu =
        spent / (out.step * static_cast<double>(steps) * static_cast<double>(out.waveform.size()));
    return out;
}

} // namespace ode::soft
