// softsound inspect MESH: what a mesh is worth, before an hour is spent on it.

#include "scenes/world.h"
#include "softsound/command.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace softsound {
namespace {

struct Options {
    std::string mesh;
    double scale = 1;
};

constexpr double kTiny = 1e-3;  // [m] its modes lie above hearing
constexpr double kSliver = 0.1; // of quality: costs the explicit step a factor of about ten

std::string number(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", x);
    return text;
}

/// What a user should know. Sentences name thing, value and cure.
std::vector<std::string> warnings(const dSoftMeshQuality& q, double longest) {
    std::vector<std::string> out;
    if (longest > kSuspiciousLength)
        out.push_back("the mesh is " + number(longest) +
                      " m long: millimetres taken for metres? Then --scale 0.001");
    if (longest < kTiny)
        out.push_back("the mesh is " + number(longest) +
                      " m long: metres taken for millimetres? Then --scale 1000");
    if (q.min_quality < kSliver)
        out.push_back("element " + std::to_string(q.worst) + " is a sliver of quality " +
                      number(q.min_quality) +
                      ": the whole body will take its small steps; remesh with optimisation on");
    if (q.parts > 1)
        out.push_back("the mesh falls into " + std::to_string(q.parts) +
                      " parts that share no node: one body each would be cheaper, and merging "
                      "duplicate nodes may be what is wanted");
    if (q.doubtful_edges > 0)
        out.push_back(std::to_string(q.doubtful_edges) +
                      " surface edges of 35 to 80 degrees could be a coarse round or a corner: "
                      "mesh rounds with at least ten facets, or pitches will be off");
    return out;
}

int run(const Options& o, const Common& common) {
    const ode::soft::MeshHandle mesh(scenes::made(dSoftMeshLoad(o.mesh.c_str())));
    dSoftMeshQuality q = {};
    q.struct_size = sizeof q;
    if (!dSoftMeshGetQuality(mesh, &q))
        return 1;
    // Lengths scale; counts and the quality of a shape don't.
    q.volume *= o.scale * o.scale * o.scale;
    q.min_edge *= o.scale;
    q.max_edge *= o.scale;
    for (dReal& bound : q.bounds)
        bound *= o.scale;
    const double sides[] = {q.bounds[1] - q.bounds[0], q.bounds[3] - q.bounds[2],
                            q.bounds[5] - q.bounds[4]};
    const double longest = std::max({sides[0], sides[1], sides[2]});
    const std::vector<std::string> said = warnings(q, longest);

    if (common.summarises()) {
        std::printf("%s\n", o.mesh.c_str());
        std::printf("  nodes              %d\n", q.nodes);
        std::printf("  elements           %d\n", q.elements);
        std::printf("  surface triangles  %d\n", q.surface_triangles);
        std::printf("  parts              %d\n", q.parts);
        std::printf("  size               %.4g x %.4g x %.4g m\n", sides[0], sides[1], sides[2]);
        std::printf("  volume             %.4g m^3\n", q.volume);
        std::printf("  edges              %.4g to %.4g m\n", q.min_edge, q.max_edge);
        std::printf("  worst quality      %.3f, element %d (1 regular, 0 flat)\n", q.min_quality,
                    q.worst);
        for (const std::string& sentence : said)
            std::printf("  warning: %s\n", sentence.c_str());
    }
    write_json(common, {{"mesh", o.mesh},
                        {"scale", o.scale},
                        {"nodes", q.nodes},
                        {"elements", q.elements},
                        {"surface_triangles", q.surface_triangles},
                        {"parts", q.parts},
                        {"bounds", q.bounds},
                        {"volume", q.volume},
                        {"min_edge", q.min_edge},
                        {"max_edge", q.max_edge},
                        {"min_quality", q.min_quality},
                        {"worst_element", q.worst},
                        {"doubtful_edges", q.doubtful_edges},
                        {"warnings", said}});
    return 0;
}

} // namespace

void add_inspect(CLI::App& app, Common& common) {
    auto options = std::make_shared<Options>();
    CLI::App& inspect = *app.add_subcommand("inspect", "Say what a mesh is worth");
    inspect
        .add_option("mesh", options->mesh, "Gmsh .msh, TetGen .node/.ele, legacy .vtk, Medit .mesh")
        ->required()
        ->type_name("MESH");
    inspect.add_option("--scale", options->scale, "Metres per unit of the file")
        ->check(positive_number())
        ->capture_default_str();
    add_common(inspect, common);
    inspect.callback([options, &common] {
        common.action = [options, &common] { return run(*options, common); };
    });
}

} // namespace softsound
