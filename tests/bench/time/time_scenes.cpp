#include "bench/time/time_scenes.h"

#include "bench/time/timed_run.h"
#include "mesh/generate.h"
#include "mesh/promote.h"
#include "modal/modal_decay.h"
#include "modal/solve_modes.h"
#include "support/pitch_cases.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ode::soft {
namespace {

constexpr std::size_t kRinging = 4;

/// The lowest modes of a body, on the nodes of the promoted mesh.
ModalModel lowest_modes(const TetMesh& promoted, const Solid& solid, std::size_t count) {
    ModalOptions options;
    options.max_modes = count;
    options.max_frequency = 1e6;
    return solve_modes(promoted, {&solid, 1}, options);
}

/// Velocities of all modes with one amplitude.
struct Start {
    std::vector<Vec3> velocity; ///< of each node [m/s]
    double amplitude;           ///< mass-normalised
};

/// @param displacement  the largest, if all modes reached their turning points at once [m]
Start all_equal(const ModalModel& modes, double displacement) {
    Start out{std::vector<Vec3>(modes.node_count, Vec3::Zero()), 0};
    double largest = 0;
    for (std::size_t i = 0; i < modes.node_count; ++i) {
        double reach = 0;
        for (std::size_t k = 0; k < modes.mode_count(); ++k) {
            const Vec3 shape = modes.shape_at(k, i);
            out.velocity[i] += shape;
            reach += shape.norm() / (2 * std::numbers::pi * modes.frequency[k]);
        }
        largest = std::max(largest, reach);
    }
    out.amplitude = displacement / largest;
    for (Vec3& v : out.velocity)
        v *= out.amplitude;
    return out;
}

/// Four modes at 1e-4 of the thickness: stiffening, of the order of its square, is out of sight.
TimeScene ringing(std::string name, const TetMesh& mesh, double thickness) {
    // T60 is 3 s at 1 kHz, and falls with the square of frequency.
    const double beta = 2 * std::log(1000.0) / 3 / std::pow(2 * std::numbers::pi * 1000, 2);
    TimeScene scene{.name = std::move(name),
                    .model = "stvk",
                    .mesh = mesh,
                    .solid = {.young = 200e9, .poisson = 0.29, .density = 7850, .beta = beta},
                    .duration = 0.01,
                    .samples = 400,
                    .start = {},
                    .modes = {},
                    .amplitude = {},
                    .decay = {}};
    const TetMesh fine = promote_to_quadratic(mesh);
    scene.modes = lowest_modes(fine, scene.solid, 4);
    scene.decay = modal_decays(fine, {&scene.solid, 1}, scene.modes);
    Start start = all_equal(scene.modes, 1e-4 * thickness);
    scene.start = std::move(start.velocity);
    scene.amplitude.assign(scene.modes.mode_count(), start.amplitude);
    return scene;
}

/// Two modes, bent and twisted by a fifth of the thickness. No two sides are equal: modes that may
/// turn freely would start differently on another mesh.
std::vector<Vec3> large_swing(const TetMesh& mesh, const Solid& solid) {
    return all_equal(lowest_modes(promote_to_quadratic(mesh), solid, 2), 0.2 * 0.08).velocity;
}

TimeScene swinging_block() {
    TimeScene scene{.name = "soft block",
                    .model = "stable-neo-hookean",
                    .mesh = make_box({0.2, 0.11, 0.08}, 6, 3, 3),
                    .solid = {.young = 1e5, .poisson = 0.4, .density = 1000},
                    .duration = 0.1,
                    .samples = 50,
                    .start = {},
                    .modes = {},
                    .amplitude = {},
                    .decay = {}};
    scene.start = large_swing(scene.mesh, scene.solid);
    return scene;
}

} // namespace

std::vector<TimeScene> time_scenes() {
    return {ringing("bar", make_bar(0.3, 0.02, 0.01, 14, 1, 1), 0.01),
            ringing("bowl", make_bowl(0.1, 0.005, std::numbers::pi / 2, 8, 48, 1), 0.005),
            swinging_block()};
}

Waveform reference_of(const TimeScene& scene) {
    if (!scene.closed_form()) {
        // Half as large elements, and steps whose error is beyond the eighth digit.
        TimeScene fine = scene;
        fine.mesh = refined(scene.mesh);
        fine.start = large_swing(fine.mesh, fine.solid);
        Waveform out = run(fine, {"runge-kutta-4", 2, 0.25}, 1e9).waveform;
        for (std::vector<Vec3>& sample : out)
            sample.resize(scene.mesh.node.size());
        return out;
    }
    Waveform out(static_cast<std::size_t>(scene.samples),
                 std::vector<Vec3>(scene.mesh.node.size(), Vec3::Zero()));
    for (std::size_t k = 0; k < scene.amplitude.size(); ++k) {
        const double d = scene.decay[k], w0 = 2 * std::numbers::pi * scene.modes.frequency[k];
        const double w = std::sqrt(w0 * w0 - d * d);
        for (int n = 0; n < scene.samples; ++n) {
            const double t = scene.duration * (n + 1) / scene.samples;
            const double rate =
                scene.amplitude[k] * std::exp(-d * t) * (std::cos(w * t) - d / w * std::sin(w * t));
            for (std::size_t i = 0; i < scene.mesh.node.size(); ++i)
                out[static_cast<std::size_t>(n)][i] += rate * scene.modes.shape_at(k, i);
        }
    }
    return out;
}

} // namespace ode::soft
