// softsound modes MESH: the pitches of a body, and how far each can be trusted.

#include "softsound/modes.h"

#include "scenes/world.h"
#include "softsound/command.h"
#include "softsound/progress.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace softsound {
namespace {

constexpr double kHuge = 50;      // [m] the longest side from which millimetres are suspected
constexpr int kMostUnasked = 100; // modes, without --count: a large soft body has thousands
constexpr double kAudible = 3;    // [cents] about what a trained ear tells apart

struct Options {
    std::string mesh;
    MaterialChoice material;
    std::vector<std::string> clamps;
    double scale = 0; // 0: not given
    int order = 3;
    std::string mass = "consistent";
    double tolerance = 0;
    int count = 0;
    double max_frequency = 0; // 0: not given
    int max_nodes = dSoftModesOptionsDefault().max_nodes;
    bool facets = false;
    bool no_cache = false;
};

/// A line of progress for each stage: their lengths can't be compared beforehand.
struct Stages {
    bool quiet;
    std::string now;
    std::optional<Progress> line;

    static int at(void* self, const char* stage, dReal share, int) {
        auto& s = *static_cast<Stages*>(self);
        if (s.now != stage) {
            s.now = stage;
            s.line.emplace(s.now, 1.0, s.quiet);
        }
        s.line->at(share);
        return 1;
    }
};

void warn(const Common& common, const std::string& sentence) {
    if (!common.quiet)
        std::fprintf(stderr, "softsound: %s\n", sentence.c_str());
}

std::string number(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", x);
    return text;
}

std::string fixed(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", x);
    return text;
}

/// Applies --scale, or refuses what looks like millimetres; warns of what may be.
void settle_scale(dSoftMeshID mesh, const Options& o, const Common& common) {
    if (o.scale > 0) {
        if (!dSoftMeshScale(mesh, o.scale))
            throw scenes::Refused("scale");
        return;
    }
    const Bounds b = bounds_of(mesh);
    double longest = 0;
    for (int axis = 0; axis < 3; ++axis)
        longest = std::max(longest, b.high[axis] - b.low[axis]);
    if (longest > kHuge)
        throw std::runtime_error("the mesh is " + number(longest) +
                                 " m long: millimetres taken for metres? Then --scale 0.001; "
                                 "if metres are right, --scale 1");
    if (longest > kSuspiciousLength)
        warn(common, "the mesh is " + number(longest) +
                         " m long: millimetres taken for metres? Then --scale 0.001; if metres are "
                         "right, --scale 1 says so");
}

void print_table(const Options& o, const dSoftModesInfo& info, std::span<const double> frequencies,
                 std::span<const double> cents, std::span<const double> t60, double seconds) {
    std::printf("%s\n", o.mesh.c_str());
    std::printf("  nodes      %d\n", info.nodes);
    std::printf("  elements   %d\n", info.elements);
    std::printf("  mass       %.6g kg\n", info.mass);
    std::printf("  volume     %.6g m^3\n", info.volume);
    std::printf("  inertia    %.4g %.4g %.4g kg m^2 about the centre of mass, along x y z\n",
                info.inertia[0][0], info.inertia[1][1], info.inertia[2][2]);
    std::printf("  rigid      %d motions without strain, not listed\n", info.rigid_modes);
    std::printf("  solved     %d nodes after %d refinements, order %d, %.2f s\n\n",
                info.solved_nodes, info.refinements, o.order, seconds);
    std::printf("  mode   frequency [Hz]   error [cents]   T60 [s]\n");
    for (std::size_t k = 0; k < frequencies.size(); ++k) {
        std::printf("  %4zu   %14.3f   %13s", k + 1, frequencies[k],
                    ("+-" + fixed(cents[k])).c_str());
        std::isfinite(t60[k]) ? std::printf("   %7.3g\n", t60[k]) : std::printf("         -\n");
    }
}

/// What a user should know about the result.
void comment(const Common& common, const Options& o, const dSoftModesInfo& info,
             std::span<const double> cents) {
    const auto first = cents.first(std::min<std::size_t>(8, cents.size()));
    const double widest = first.empty() ? 0 : *std::max_element(first.begin(), first.end());
    if (widest > kAudible && o.tolerance == 0)
        warn(common, "the estimated error of the first partials reaches " + number(widest) +
                         " cents: --tolerance " + number(kAudible) + " refines the mesh");
    if (info.limited_edges > 0 || info.doubtful_edges > 0)
        warn(common, std::to_string(info.doubtful_edges) +
                         " surface edges could be a coarse round or a corner, and " +
                         std::to_string(info.limited_edges) +
                         " could not be curved as they should: the band may not hold; mesh rounds "
                         "with at least ten facets, or say --facets if they are meant");
    if (info.rigid_modes > 6)
        warn(common,
             "the body has " + std::to_string(info.rigid_modes) +
                 " motions without strain, 6 a piece: it falls into parts, or they hang "
                 "together by a node or an edge; merge duplicate nodes if it should be one");
    if (cents.empty())
        warn(common, "no elastic mode up to the highest frequency: --count N gives the lowest");
    else if (o.count == 0 && cents.size() == kMostUnasked)
        warn(common, "there are more modes: --count N gives as many as you like");
}

int run(const Options& o, const Common& common) {
    const ode::soft::MeshHandle mesh(scenes::made(dSoftMeshLoad(o.mesh.c_str())));
    settle_scale(mesh, o, common);
    const std::vector<dSoftSolid> solids = choose_solids(mesh, o.material);
    const std::vector<int> clamped = clamped_nodes(mesh, o.clamps);

    Stages stages{common.quiet, {}, {}};
    dSoftModesOptions options = dSoftModesOptionsDefault();
    options.order = o.order;
    options.lumped = o.mass == "lumped";
    options.count = o.count ? o.count : kMostUnasked;
    if (o.max_frequency > 0)
        options.max_frequency = o.max_frequency;
    else if (o.count)
        options.max_frequency = dInfinity; // so many were asked for, wherever they lie
    options.tolerance = o.tolerance;
    options.tolerance_count = o.count ? std::min(o.count, 8) : 8;
    options.max_nodes = o.max_nodes;
    options.rebuilt_curves = !o.facets;
    options.use_cache = !o.no_cache;
    options.progress = Stages::at;
    options.progress_data = &stages;

    const auto start = std::chrono::steady_clock::now();
    const ode::soft::ModesHandle modes(scenes::made(dSoftModesCompute(
        mesh, solids.data(), static_cast<int>(solids.size()),
        o.clamps.empty() ? nullptr : clamped.data(), static_cast<int>(clamped.size()), &options)));
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    stages.line.reset();

    dSoftModesInfo info = {};
    info.struct_size = sizeof info;
    dSoftModesGetInfo(modes, &info);
    const dReal *f = nullptr, *e = nullptr, *t = nullptr;
    const auto count = static_cast<std::size_t>(dSoftModesGetFrequencies(modes, &f));
    dSoftModesGetErrorCents(modes, &e);
    dSoftModesGetT60(modes, &t);
    const std::span frequencies(f, count), cents(e, count), t60(t, count);

    if (common.summarises())
        print_table(o, info, frequencies, cents, t60, seconds);
    comment(common, o, info, cents);
    write_json(common, {{"nodes", info.nodes},
                        {"elements", info.elements},
                        {"mass", info.mass},
                        {"volume", info.volume},
                        {"inertia", info.inertia},
                        {"frequencies", frequencies},
                        {"error_cents", cents},
                        {"seconds", seconds}});
    return 0;
}

} // namespace

void add_modes(CLI::App& app, Common& common) {
    auto options = std::make_shared<Options>();
    Options& o = *options;
    CLI::App& modes = *app.add_subcommand(
        "modes", "Frequencies of a body's elastic vibrations, each with its estimated error");
    modes.add_option("mesh", o.mesh, "Gmsh .msh, TetGen .node/.ele, legacy .vtk, Medit .mesh")
        ->required()
        ->type_name("MESH");
    add_material(modes, o.material);
    modes
        .add_option("--clamp", o.clamps,
                    "Nodes held still: axis, < or >, value in metres, such as 'x<1e-6'; several "
                    "are a union")
        ->type_name("CONDITION")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    modes.add_option("--order", o.order, "Of the displacement in an element; 3: right to cents")
        ->check(CLI::Range(1, 3))
        ->capture_default_str();
    modes.add_option("--mass", o.mass, "Lumped: as in explicit steps")
        ->check(CLI::IsMember({"consistent", "lumped"}))
        ->capture_default_str();
    modes
        .add_option("--tolerance", o.tolerance,
                    "Refine until the first eight (or --count) partials are right to so many cents")
        ->check(positive_number())
        ->type_name("CENTS");
    modes.add_option("--count", o.count, "Lowest so many modes; without: up to --max-frequency")
        ->check(CLI::Range(1, 1000000))
        ->type_name("N");
    modes
        .add_option("--max-frequency", o.max_frequency,
                    "In Hz; 22000 without --count, and 100 modes at most")
        ->check(positive_number())
        ->type_name("HZ");
    modes.add_option("--max-nodes", o.max_nodes, "Limit of --tolerance's refinement")
        ->check(CLI::Range(10, 100000000))
        ->capture_default_str();
    modes.add_option("--scale", o.scale, "Metres per unit of the file")->check(positive_number());
    modes.add_flag("--facets", o.facets,
                   "Facets are meant: don't take those that meet below 50 degrees for a round");
    modes.add_flag("--no-cache", o.no_cache, "Neither look results up on disk nor keep them");
    modes.footer("Frequencies in Hz, ascending, rigid motions left out; errors in cents (1200 an "
                 "octave);\nmass in kg, volume in m^3, inertia in kg m^2 about the centre of mass, "
                 "all with the\nsurface rebuilt as it was solved; 'nodes' and 'elements' are the "
                 "file's.");
    add_common(modes, common);
    modes.callback([options, &common] {
        common.action = [options, &common] { return run(*options, common); };
    });
}

} // namespace softsound
