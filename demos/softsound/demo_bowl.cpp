// The bowl: a hemisphere of steel, glass or wood (R 0.1 m, 5 mm; the size of the source paper's)
// falls half a metre, tilted, on the floor, and bounces.
//
// Mathematics. Solid: Green strain E = (F^T F - I)/2 in linear tetrahedra, S = lambda tr(E) I +
// 2 mu E and its viscous counterpart, lumped mass, central differences at 0.9 of the critical step
// (P01 3.1), where x = c + R (X + Phi q) with q'' + 2 d q' + w^2 q = 0 mode by mode wouldn't be
// right to 2.5 % (--tolerance, --tier). Floor: a penalty on the surface nodes' depth with Coulomb
// friction. Sound: of every surface triangle, p = rho/(4 pi) a dv_n/dt (t - R/c) / R at each ear,
// which is what the air does while the body is small against the wavelength; no shadowing. Free
// fall takes sqrt(2 h / g) = 0.319 s from h = 0.5 m.
//
// Command. softsound demo bowl, bowl-glass, bowl-wood [--order 2] [--tier explicit] [--out
// bowl.wav] [--plot bowl.png]
//          [--json bowl.json]
//
// Expected. bowl.wav, bowl.png, bowl.json. Silence till 0.32 s, when the rim's lowest point
// strikes; then a clang, again at each bounce. The lines of the spectrogram stand still from one
// impact to the next, at the modes marked at its right edge, and change only in strength (figures:
// impact_lines). Glass rings as long, a little lower; wood is dull within a tenth of a second.
// Linear tetrahedra are too stiff in bending: the lowest partial is two octaves above a real
// bowl's;
// --order 2 brings it down, for twelve times the cost.

#include "plots/partials.h"
#include "plots/sound_picture.h"
#include "scenes/drop.h"
#include "softsound/demo.h"
#include "softsound/exhibit.h"
#include "softsound/impact_lines.h"
#include "softsound/impacts.h"
#include "softsound/performance.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <numbers>

namespace softsound {
namespace {

constexpr const char* kAbout =
    "A bowl (hemisphere, R 0.1 m, 5 mm; the source paper's size) falls half a metre on the\n"
    "floor and bounces.\n\n"
    "Mathematics: Green strain, St.Venant-Kirchhoff stress with its viscous part, linear\n"
    "tetrahedra, lumped mass, central differences at 0.9 of the critical step; a penalty on the\n"
    "depth of surface nodes, Coulomb friction; where that is right to the tolerance, the exact\n"
    "motion of the vibration modes in a frame that flies and turns (--tier explicit: never). Each\n"
    "surface triangle radiates\n"
    "rho/(4 pi) a dv_n/dt(t - R/c) / R to each ear, a metre away at 1.6 m height.\n\n"
    "Expected: silence till sqrt(2 h / g) = 0.32 s, then a clang at each bounce; the lines of the\n"
    "spectrogram lie at the modes marked at its right edge and change only in strength. Linear\n"
    "tetrahedra are too stiff in bending: the lowest partial is two octaves above a real bowl's;\n"
    "--order 2 brings it down, for twelve times the cost.";

constexpr int kModes = 40;        // marked: about as many as lie below 20 kHz
constexpr double kTop = 20000;    // [Hz] hearing ends
constexpr double kFlight = 0.015; // [s] the rim's chatter within one landing is faster

constexpr std::size_t kImpacts = 5; // as the source paper's figure shows

constexpr double kLate = 0.03; // [s] travel over 1.6 m takes 5 ms, the chatter of a landing 15 ms

struct Options {
    scenes::Drop drop;
    Stage stage;
    double tolerance = 0.025;
    std::string tier = "auto";
    bool judges_elements = false;
};

/// Predicted modes up to where hearing ends [Hz].
std::vector<double> audible_modes(dSoftBodyID body) {
    std::vector<double> modes(kModes);
    modes.resize(static_cast<std::size_t>(dSoftBodyGetModes(body, kModes, modes.data())));
    std::erase_if(modes, [](double f) { return f > kTop; });
    return modes;
}

/// The longest stretch of sound without an impact in it, as long as it rings.
/// @param longest_t60  of any mode [s]
std::span<const float> longest_ring(const Performance& p, const std::vector<double>& impacts,
                                    double longest_t60) {
    std::vector<Ring> all = rings(impacts, p.seconds, kLate);
    for (Ring& ring : all)
        ring.end = std::min(ring.end, ring.begin + longest_t60);
    std::span<const float> longest;
    for (const Ring& ring : all) {
        const auto sample = [&](double t) {
            return std::min(p.left.size(), static_cast<std::size_t>(t * p.rate));
        };
        const std::size_t first = sample(ring.begin), end = sample(ring.end);
        if (end > first && end - first > longest.size())
            longest = std::span(p.left).subspan(first, end - first);
    }
    return longest;
}

/// Rayleigh's damping: T60 = ln 1000 / d, d = (alpha + beta w^2) / 2 [s].
double t60_of(const dSoftSolid& solid, double frequency) {
    const double w = 2 * std::numbers::pi * frequency;
    return 2 * std::log(1000.0) / (solid.alpha + solid.beta * w * w);
}

/// How far a line may be from its mode: the body falls and rises towards the ear (v / c, 16 cents
/// from half a metre), and a window of a tenth of a second blurs [cents].
double reach(const scenes::Drop& drop) {
    constexpr double kSound = 343, kBlur = 6; // [m/s], [cents]
    return 1200 * std::log2(1 + std::sqrt(2 * 9.81 * drop.height) / kSound) + kBlur;
}

void summarise(const nlohmann::ordered_json& r, const Performance& p, const Options& o) {
    std::printf("%s: %d nodes, %d elements, %.3f kg, substep %.3g s, ODE's step %.4g s\n",
                o.stage.name.c_str(), r["nodes"].get<int>(), r["elements"].get<int>(),
                r["mass"].get<double>(), r["substep"].get<double>(), o.stage.step);
    std::printf("time: %.2f CPU seconds per simulated second, %.1f %% of it audio\n",
                p.cpu / p.seconds, 100 * p.sound.seconds / p.cpu);
    if (o.stage.radiation == "paper")
        std::printf("level: peak %.3g Pa m (the paper's rule, no pressure)\n", p.sound.peak);
    else
        std::printf("level: peak %.3g Pa, %.0f dB SPL\n", p.sound.peak,
                    sound_pressure_level(p.sound.peak));
    std::printf("impacts at:");
    for (const auto& t : r["impacts"])
        std::printf(" %.3f", t.get<double>());
    std::printf(" s\nlowest modes at:");
    for (std::size_t i = 0; i < std::min<std::size_t>(8, r["modes"].size()); ++i)
        std::printf(" %.0f", r["modes"][i].get<double>());
    std::printf(" Hz\n");
    for (std::size_t i = 0; i < std::min<std::size_t>(8, r["partials"].size()); ++i) {
        const auto& partial = r["partials"][i];
        std::printf("  predicted %8.1f Hz, heard %8.1f Hz (%+.1f cents)\n",
                    partial["predicted"].get<double>(), partial["measured"].get<double>(),
                    partial["cents"].get<double>());
    }
    const auto& lines = r["impact_lines"];
    std::printf(
        "lines after the first impacts: the same to %.1f cents, reweighted by up to %.0f dB\n",
        lines["drift_cents"].get<double>(), lines["reweighted_db"].get<double>());
    std::printf("sound in %s\n", o.stage.out.c_str());
    if (p.live_kind == "openal" && p.sound.underruns > 0)
        std::printf("live: %lu gaps, because the simulation ran at %.2f of real time\n",
                    p.sound.underruns, p.seconds / p.wall);
}

ode::soft::MeshHandle mesh_of(const scenes::Drop& drop) {
    return drop.mesh.empty() ? scenes::paper_bowl()
                             : ode::soft::MeshHandle(dSoftMeshLoad(drop.mesh.c_str()));
}

int run(const Options& o, const Common& common) {
    scenes::World world;
    const dSoftBodyID body = scenes::build(world, o.drop);
    dSoftBodySetAutoDisableFlag(body, 1); // what lies still costs nothing
    if (!dSoftBodySetTier(body, o.tier.c_str()))
        throw scenes::Refused("the body can't be had in this tier");
    if (!dSoftBodySetWaveformTolerance(body, o.tolerance))
        throw scenes::Refused("--tolerance can't be kept");
    const std::vector<double> modes = audible_modes(body);
    Performance p;
    std::vector<double> impacts;
    {
        const Impacts watch(world.soft(), body, kFlight);
        p = perform(world, o.stage, common.quiet);
        impacts = watch.times();
    }
    const dSoftSolid solid = preset(o.drop.material);
    const double t60 = modes.empty() ? p.seconds : t60_of(solid, modes.front());
    const std::span<const float> ring = longest_ring(p, impacts, t60);
    std::vector<double> lasting = modes; // what has died before it is looked for is no line
    std::erase_if(lasting, [&](double f) { return t60_of(solid, f) < kLate; });
    const std::vector<plots::Partial> partials =
        plots::find_partials(ring, p.rate, lasting, reach(o.drop));
    std::vector<double> lines;
    for (const plots::Partial& partial : partials)
        lines.push_back(partial.predicted);
    std::vector<Ring> after = rings(impacts, p.seconds, kLate);
    impacts.resize(std::min<std::size_t>(impacts.size(), kImpacts));
    after.resize(impacts.size());

    dSoftStatus status = {};
    status.struct_size = sizeof status;
    dSoftBodyGetStatus(body, &status);
    const dReal* first = nullptr;
    const int* triangle = nullptr;
    int stride = 0;
    nlohmann::ordered_json results = {
        {"demo", o.stage.name},
        {"material", o.drop.material},
        {"order", dSoftBodyGetOrder(body)},
        {"model", dSoftBodyGetMaterialModel(body)},
        {"nodes", dSoftBodyGetPositions(body, &first, &stride)},
        {"surface_elements", dSoftBodyGetTriangles(body, &triangle)},
        {"elements", dSoftMeshGetElements(mesh_of(o.drop), nullptr)},
        {"mass", dSoftBodyGetMass(body)},
        {"step", o.stage.step},
        {"substep", status.substep},
        {"critical_step", status.critical_step},
        {"stopped", status.stopped != 0},
        {"tier", o.tier},
        {"modal_share", p.world.body_substeps
                            ? static_cast<double>(p.world.modal_substeps) / p.world.body_substeps
                            : 0},
        {"impacts", impacts},
        {"modes", modes},
        {"t60_of_lowest", t60},
        {"partials", as_json(partials)},
        {"impact_lines", follow_lines(p.left, p.rate, after, lines, reach(o.drop))}};
    if (o.judges_elements) {
        const ode::soft::MeshHandle mesh = mesh_of(o.drop);
        results.update(first_mode(body, mesh, solid, {}));
    }
    results.update(as_json(p));
    results["out"] = o.stage.out;

    if (!o.stage.plot.empty()) {
        const plots::SoundPicture picture{o.stage.name + " of " + o.drop.material, p.left,
                                          static_cast<double>(p.rate), modes, kTop};
        if (const std::string why = plots::draw(picture, o.stage.plot); why.empty())
            results["plot"] = o.stage.plot;
        else
            std::cerr << "softsound: no picture: " << why << '\n';
    }
    if (common.summarises())
        summarise(results, p, o);
    write_json(common, results);
    return status.stopped ? 1 : 0;
}

} // namespace

namespace {

void add(CLI::App& demo, Common& common, const char* name, const char* material) {
    auto options = std::make_shared<Options>();
    options->stage.name = name;
    options->drop.material = material;
    CLI::App& bowl = *demo.add_subcommand(name, "A bowl of " + options->drop.material +
                                                    " falls on the floor and bounces");
    bowl.footer(kAbout);
    add_stage(bowl, options->stage);
    bowl.add_option("--mesh", options->drop.mesh, "Drop this mesh instead (lengths in metres)")
        ->type_name("FILE");
    bowl.add_option("--material", options->drop.material, "Name of a preset")
        ->capture_default_str();
    bowl.add_option("--order", options->drop.order,
                    "Of the elements: 1 is cheap and sharp, 2 in tune; default: the mesh's own")
        ->check(CLI::IsMember({1, 2}));
    bowl.add_option("--model", options->drop.model, "Constitutive law")
        ->check(CLI::IsMember({"stvk", "corotated", "stable-neo-hookean"}))
        ->capture_default_str();
    bowl.add_option("--height", options->drop.height, "Of the lowest point above the floor [m]")
        ->check(CLI::Range(0.0, 100.0))
        ->capture_default_str();
    bowl.add_option("--tilt", options->drop.tilt, "From upright [rad]")->capture_default_str();
    bowl.add_option("--step", options->stage.step, "Of ODE [s]")
        ->check(CLI::Range(1e-5, 0.1))
        ->capture_default_str();
    bowl.add_option("--tolerance", options->tolerance,
                    "Error of the waveform that the automatic tier accepts, relative")
        ->check(CLI::Range(1e-4, 1.0))
        ->capture_default_str();
    bowl.add_option("--tier", options->tier,
                    "How the body moves: node by node, in its vibration modes, or in these while "
                    "the tolerance is kept")
        ->check(CLI::IsMember({"auto", "explicit", "modal", "cubic"}))
        ->capture_default_str();
    bowl.add_flag("--judge-elements", options->judges_elements,
                  "Also how far the elements are off in pitch");
    add_action(bowl, common, name, [options, &common] { return run(*options, common); });
}

} // namespace

void add_demo_bowl(CLI::App& demo, Common& common) {
    add(demo, common, "bowl", "steel");
    add(demo, common, "bowl-glass", "glass");
    add(demo, common, "bowl-wood", "wood");
}

} // namespace softsound
