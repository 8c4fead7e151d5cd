// softsound strike MESH: hears a body that was never heard before. It floats, is struck once by a
// ball of ODE's, and rings; sound, picture and figures as of a demo.

#include "scenes/mallet.h"
#include "softsound/exhibit.h"
#include "softsound/modes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <stdexcept>

namespace softsound {
namespace {

struct Options {
    std::string mesh;
    MaterialChoice material;
    std::vector<std::string> clamps;
    double scale = 1;
    std::string at;                     ///< x,y,z [m]; empty: the top
    std::string hammer = "0.01,0.01,1"; ///< mass, radius, speed [kg, m, m/s]
    Exhibit exhibit;
};

/// Three numbers between commas.
std::array<double, 3> read_three(const std::string& text, const char* option, const char* form) {
    std::array<double, 3> out{};
    const char* at = text.c_str();
    for (std::size_t i = 0; i < 3; ++i) {
        char* end = nullptr;
        out[i] = std::strtod(at, &end);
        if (end == at || !std::isfinite(out[i]) || *end != (i < 2 ? ',' : '\0'))
            throw std::runtime_error(std::string(option) + " '" + text + "' can't be read: write " +
                                     form);
        at = end + 1;
    }
    return out;
}

/// Of the surface node nearest to a place, where the blow lands.
struct Target {
    dVector3 place, outward;
};

Target find_target(dSoftBodyID body, const std::array<double, 3>& wanted) {
    const int* triangle = nullptr;
    const int count = dSoftBodyGetTriangles(body, &triangle);
    const dReal* x = nullptr;
    int stride = 0;
    dSoftBodyGetPositions(body, &x, &stride);
    const auto place = [&](int node) { return x + static_cast<std::ptrdiff_t>(node) * stride; };
    int nearest = triangle[0];
    double least = HUGE_VAL;
    for (int i = 0; i < 3 * count; ++i) {
        double square = 0;
        for (int k = 0; k < 3; ++k)
            square += std::pow(place(triangle[i])[k] - wanted[static_cast<std::size_t>(k)], 2);
        if (square < least) {
            least = square;
            nearest = triangle[i];
        }
    }
    Target target{};
    std::copy_n(place(nearest), 3, target.place);
    for (int t = 0; t < count; ++t) {
        const int* node = triangle + 3 * static_cast<std::ptrdiff_t>(t);
        if (node[0] != nearest && node[1] != nearest && node[2] != nearest)
            continue;
        dVector3 a, b, area;
        for (int k = 0; k < 3; ++k) {
            a[k] = place(node[1])[k] - place(node[0])[k];
            b[k] = place(node[2])[k] - place(node[0])[k];
        }
        dCalcVectorCross3(area, a, b);
        for (int k = 0; k < 3; ++k)
            target.outward[k] += area[k];
    }
    dNormalize3(target.outward);
    return target;
}

Shown build(scenes::World& world, const Exhibit& e, const Options& o) {
    Shown shown;
    dWorldSetGravity(world.ode(), 0, 0, 0); // it floats
    const ode::soft::MeshHandle mesh(scenes::made(dSoftMeshLoad(o.mesh.c_str())));
    if (!dSoftMeshScale(mesh, o.scale))
        throw scenes::Refused("scale");
    const Bounds bounds = bounds_of(mesh);
    double size = 0;
    for (int k = 0; k < 3; ++k)
        size = std::max(size, bounds.high[k] - bounds.low[k]);
    if (size > kSuspiciousLength)
        throw std::runtime_error("the mesh is " + std::to_string(size) +
                                 " m long: millimetres taken for metres? Then --scale 0.001");
    const std::vector<dSoftSolid> solids = choose_solids(mesh, o.material);
    shown.elements = dSoftMeshGetElements(mesh, nullptr);
    shown.material = o.material.given.empty() ? "numbers" : o.material.given[0];
    shown.body = scenes::made(
        dSoftBodyCreateGroups(world.soft(), mesh, solids.data(), static_cast<int>(solids.size())));
    const std::vector<int> held = clamped_nodes(mesh, o.clamps);
    Exhibit own = e;
    own.order = std::max(e.order, dSoftMeshGetOrder(mesh));
    shape(shown.body, own);
    if (!o.clamps.empty())
        dSoftBodyPinNodes(shown.body, held.data(), static_cast<int>(held.size()));
    dVector3 middle;
    dSoftBodyGetCenterOfMass(shown.body, middle);
    const std::array<double, 3> at =
        o.at.empty() ? std::array<double, 3>{middle[0], middle[1], bounds.high[2]}
                     : read_three(o.at, "--at", "x,y,z in metres, such as 0.1,0,0.02");
    const std::array<double, 3> hammer =
        read_three(o.hammer, "--hammer", "mass,radius,speed, such as 0.01,0.01,1");
    if (!(hammer[0] > 0) || !(hammer[1] > 0) || !(hammer[2] > 0))
        throw std::runtime_error("--hammer '" + o.hammer + "': all three must be above 0");
    const Target target = find_target(shown.body, at);
    constexpr double kFlight = 0.02; // [s]
    dVector3 start, velocity;
    for (int k = 0; k < 3; ++k) {
        start[k] = target.place[k] + (hammer[1] + hammer[2] * kFlight) * target.outward[k];
        velocity[k] = -hammer[2] * target.outward[k];
    }
    auto mallet = std::make_shared<scenes::Mallet>(world, hammer[0], hammer[1], start, velocity);
    shown.drive = [mallet](double) { mallet->watch(); };
    return shown;
}

int run(const Options& o, const Common& common) {
    Exhibit e = o.exhibit;
    const Build make = [&o](scenes::World& world, const Exhibit& own) {
        return build(world, own, o);
    };
    return run_exhibit(e, make, {}, common);
}

} // namespace

void add_strike(CLI::App& app, Common& common) {
    auto options = std::make_shared<Options>();
    Options& o = *options;
    Exhibit& e = o.exhibit;
    e = {
        .stage = make_stage("strike", 2, 1.0 / 480, {0, -1, 0.5}), .title = "struck", .top = 20000};
    CLI::App& strike =
        *app.add_subcommand("strike", "Strikes the body of a mesh and lets it ring, floating");
    strike.add_option("mesh", o.mesh, "Gmsh .msh, TetGen .node/.ele, legacy .vtk, Medit .mesh")
        ->required()
        ->type_name("MESH");
    add_material(strike, o.material);
    strike
        .add_option("--at", o.at, "Where: the surface node nearest to x,y,z [m]; default: the top")
        ->type_name("X,Y,Z");
    strike.add_option("--hammer", o.hammer, "A ball: mass [kg], radius [m], speed [m/s]")
        ->type_name("M,R,V")
        ->capture_default_str();
    strike
        .add_option("--clamp", o.clamps,
                    "Nodes held still: axis, < or >, value in metres, such as 'x<1e-6'; several "
                    "are a union")
        ->type_name("CONDITION")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    strike.add_option("--scale", o.scale, "Metres per unit of the file")->check(positive_number());
    add_stage(strike, e.stage);
    strike.add_option("--order", e.order, "Of the elements: 1 is cheap and sharp, 2 in tune")
        ->check(CLI::IsMember({1, 2}))
        ->capture_default_str();
    strike.add_option("--tier", e.tier, "How the body moves (tier.h)")
        ->check(CLI::IsMember({"auto", "explicit", "modal", "cubic"}))
        ->capture_default_str();
    add_common(strike, common);
    strike.footer("Leaves strike.wav, strike.png and, with --json, the partials heard beside the "
                  "mesh's modes.\nThe ears are a metre away along -y, half a metre up.");
    strike.callback([options, &common] {
        common.action = [options, &common] { return run(*options, common); };
    });
}

} // namespace softsound
