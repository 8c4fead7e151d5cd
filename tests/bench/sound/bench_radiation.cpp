// softsound bench radiation: error in dB of each radiation model against closed forms and finer
// boundary elements, ka 0.05 to 10, and what each costs. Ends with 1 when a mark is missed.
//
// Time-domain models run through the whole sound path, from displacements at substeps of 2.5 us to
// the recording; `transfer` is the table's gain. The paper's rule is no pressure: its mean over ka
// is taken out.

#include "bench/sound/radiating_bodies.h"
#include "dsp/spectra.h"
#include "mix/cpu_clock.h"
#include "physics/sound/rig.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <numeric>
#include <string>

namespace ode::sound::test {
namespace {

constexpr std::array kKa = {0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0};
constexpr double kDt = 2.5e-6;

struct Row {
    std::array<double, kKa.size()> error; ///< [dB]
    double cost;                          ///< see `unit`
    const char* unit;
};

double worst(const Row& row, double up_to) {
    double most = 0.0;
    for (std::size_t i = 0; i < kKa.size(); ++i)
        if (kKa[i] <= up_to)
            most = std::max(most, std::abs(row.error[i]));
    return most;
}

/// Amplitude at the ear for unit acceleration, and CPU time of a substep.
std::pair<double, double> through_the_path(const RadiatingBody& body, Radiation radiation,
                                           double frequency) {
    Settings settings = Rig::unit_settings();
    settings.radiation = radiation;
    Scene scene;
    scene.set(settings);
    Listener& listener = scene.add_listener(0.0);
    const auto tape = std::make_shared<Recorder>();
    listener.add_sink(tape);
    listener.pose.centre = body.ear;
    listener.pose.ear_distance = 0.0;
    std::vector<int> triangle;
    for (const auto& t : body.mesh.triangle)
        triangle.insert(triangle.end(), t.begin(), t.end());
    const double w = kTau * frequency;
    const double stroke = 1e-7 / *std::max_element(body.shape.begin(), body.shape.end());
    const std::size_t nodes = body.mesh.node.size();
    std::vector<double> position(4 * nodes, 0.0), velocity(position);
    const double begin = 0.03; // the start has passed the ear
    const double end = begin + std::max(0.02, 4.0 / frequency);
    const auto steps = static_cast<long>((end + 0.01) / kDt);
    const auto move = [&](double t) {
        const double swing = stroke * std::sin(w * t), v = stroke * w * std::cos(w * t);
        for (std::size_t i = 0; i < nodes; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                const double shape = body.shape[3 * i + k];
                position[4 * i + k] =
                    body.mesh.node[i][static_cast<Eigen::Index>(k)] + shape * swing;
                velocity[4 * i + k] = shape * v;
            }
    };
    const auto timed = [&](auto&& substep) { // but for the first, which makes room
        substep(1);
        const double begun = cpu_seconds();
        for (long n = 2; n <= steps; ++n)
            substep(n);
        return cpu_seconds() - begun;
    };
    const double whole = timed([&](long n) {
        const double t = static_cast<double>(n) * kDt;
        move(t);
        scene.push(&body, triangle, {t, kDt, position.data(), velocity.data(), 4});
        if (n % 2000 == 0)
            scene.end_step(t);
    });
    const double cost = whole - timed([&](long n) { move(static_cast<double>(n) * kDt); });
    scene.end_step(static_cast<double>(steps) * kDt);
    const std::vector<double>& all = tape->ear[0];
    const auto at = [&](double t) {
        return std::min(all.size(), static_cast<std::size_t>(t * settings.rate));
    };
    const std::vector<double> part(all.begin() + static_cast<std::ptrdiff_t>(at(begin)),
                                   all.begin() + static_cast<std::ptrdiff_t>(at(end)));
    return {std::abs(phasor(part, settings.rate, frequency)) / (stroke * w * w),
            cost / static_cast<double>(steps)};
}

Row by_path(const RadiatingBody& body, Radiation radiation, const std::vector<double>& truth) {
    Row row{{}, 1e9, "ns a substep"};
    for (std::size_t i = 0; i < kKa.size(); ++i) {
        const double frequency = kKa[i] * Air{}.speed / (kTau * body.size);
        const auto [heard, cost] = through_the_path(body, radiation, frequency);
        row.error[i] = decibel(heard / truth[i]);
        row.cost = std::min(row.cost, 1e9 * cost);
    }
    if (radiation == Radiation::kPaper) {
        const double mean = std::accumulate(row.error.begin(), row.error.end(), 0.0) / kKa.size();
        for (double& e : row.error)
            e -= mean;
    }
    return row;
}

Row by_transfer(const RadiatingBody& body, const std::vector<double>& truth) {
    ModalSurface surface{body.mesh, {}, {}};
    for (const double ka : kKa) {
        surface.frequency.push_back(ka * Air{}.speed / (kTau * body.size));
        surface.shape.insert(surface.shape.end(), body.shape.begin(), body.shape.end());
    }
    const double begin = cpu_seconds();
    TransferOptions options;
    options.max_triangles = 1400;
    const TransferTable table = make_transfer_table(surface, options);
    Row row{{}, (cpu_seconds() - begin) / kKa.size(), "s a mode"};
    for (std::size_t i = 0; i < kKa.size(); ++i)
        row.error[i] = decibel(std::abs(table.gain(static_cast<int>(i), body.ear)) / truth[i]);
    return row;
}

void print(const RadiatingBody& body, const char* model, const Row& row) {
    std::printf("| %s | %s |", body.name.c_str(), model);
    for (const double e : row.error)
        std::printf(" %+.2f |", e);
    std::printf(" %.3g %s |\n", row.cost, row.unit);
    std::fflush(stdout);
}

int run(const std::string& only) {
    std::printf("| body | model |");
    for (const double ka : kKa)
        std::printf(" ka %g |", ka);
    std::printf(" CPU |\n|---|---|");
    for (std::size_t i = 0; i <= kKa.size(); ++i)
        std::printf("---|");
    std::printf("\n");
    double cheap = 0.0, best = 0.0;
    for (const RadiatingBody& body : radiating_bodies()) {
        if (body.name.find(only) == std::string::npos)
            continue;
        std::vector<double> truth;
        for (const double ka : kKa)
            truth.push_back(body.reference(body, ka));
        for (int i = 0; !radiation_name(i).empty(); ++i) {
            const auto radiation = static_cast<Radiation>(i);
            const Row row = radiation == Radiation::kTransfer ? by_transfer(body, truth)
                                                              : by_path(body, radiation, truth);
            print(body, std::string(radiation_name(i)).c_str(), row);
            if (radiation == Radiation::kTransfer)
                best = std::max(best, worst(row, kKa.back()));
            if (radiation == Radiation::kMonopole && body.compact)
                cheap = std::max(cheap, worst(row, 2.0));
        }
    }
    std::printf("\ntransfer: worst %.2f dB, mark 0.5%s\n", best, best <= 0.5 ? "" : " MISSED");
    std::printf("monopole, compact bodies to ka 2: worst %.2f dB, mark 3%s\n", cheap,
                cheap <= 3.0 ? "" : " MISSED");
    return best <= 0.5 && cheap <= 3.0 ? 0 : 1;
}

} // namespace
} // namespace ode::sound::test

int main(int argc, char** argv) {
    const bool help = argc > 1 && std::strcmp(argv[1], "--help") == 0;
    if (help || argc > 2) {
        std::fprintf(help ? stdout : stderr,
                     "softsound bench radiation [NAME]: prints a table, five minutes; of those "
                     "bodies alone whose name has NAME in it\n");
        return help ? 0 : 1;
    }
    return ode::sound::test::run(argc > 1 ? argv[1] : "");
}
