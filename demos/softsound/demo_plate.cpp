// The square plate (P01's second example with a known answer), held along its border, struck by a
// weight: on its centre, or 25 % and 17 % of its side off.
//
// Mathematics. Clamped square plate, f = lambda / (2 pi a^2) sqrt(D / (rho h)), D = E h^3 / (12 (1
// - nu^2)), lambda = 35.99, 73.41 (twice), 108.27, 131.64, 132.25, 165.15 (Leissa, NASA SP-160).
// The weight is a ball of ODE's that meets the surface by a penalty; where it strikes decides which
// modes sound: those with a node line through the centre get nothing from a blow there.
//
// Command. softsound demo plate-center, softsound demo plate-off
//
// Expected. Partials within 35 cents of Leissa's (the mesh has one element through its thickness,
// which is a tenth of an element wide). After the blow on the centre the modes (1,2), (2,2), (2,3)
// lie 30 dB and more below where the other blow leaves them.

#include "scenes/mallet.h"
#include "softsound/demo.h"
#include "softsound/exhibit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace softsound {
namespace {

constexpr double kSide = 0.3, kThickness = 3e-3; // [m]
constexpr int kCells = 20;
// Leissa's, and whether a line through the centre is at rest.
constexpr struct {
    double lambda;
    bool at_rest;
} kModes[] = {{35.99, false},  {73.41, true},   {108.27, true},
              {131.64, false}, {132.25, false}, {165.15, true}};

Shown build(scenes::World& world, const Exhibit& e, double dx, double dy) {
    Shown shown;
    shown.material = "steel";
    dSoftSolid solid = dSoftSolidDefault();
    if (!dSoftSolidPreset(shown.material.c_str(), &solid))
        throw scenes::Refused("material");
    dWorldSetGravity(world.ode(), 0, 0, 0);
    const ode::soft::MeshHandle mesh(
        scenes::made(dSoftMeshCreatePlate(kSide, kSide, kThickness, kCells, kCells, 1)));
    shown.elements = dSoftMeshGetElements(mesh, nullptr);
    shown.body = scenes::made(dSoftBodyCreate(world.soft(), mesh, &solid));
    shape(shown.body, e);
    const std::vector<int> rim = nodes_where(shown.body, [](const dReal* p) {
        return std::fmax(std::abs(p[0]), std::abs(p[1])) > kSide / 2 - 1e-9;
    });
    dSoftBodyPinNodes(shown.body, rim.data(), static_cast<int>(rim.size()));
    constexpr double kRadius = 0.01, kSpeed = 0.5, kFlight = 0.02; // [m], [m/s], [s]
    const dVector3 at = {dx * kSide, dy * kSide, kThickness / 2 + kRadius + kSpeed * kFlight};
    const dVector3 velocity = {0, 0, -kSpeed};
    auto mallet = std::make_shared<scenes::Mallet>(world, 0.01, kRadius, at, velocity);
    shown.drive = [mallet](double) { mallet->watch(); };
    shown.theory = "Leissa";
    const double stiffness =
        solid.young * std::pow(kThickness, 3) / (12 * (1 - solid.poisson * solid.poisson));
    for (const auto& mode : kModes)
        shown.predicted.push_back(mode.lambda / (2 * std::numbers::pi * kSide * kSide) *
                                  std::sqrt(stiffness / (solid.density * kThickness)));
    return shown;
}

void judge(nlohmann::ordered_json& results, const Performance& p, const Shown& shown) {
    auto levels = nlohmann::ordered_json::array();
    double rest = -300, moving = -300;
    const std::span<const float> ring =
        std::span(p.left).subspan(std::min(p.left.size(), static_cast<std::size_t>(0.1 * p.rate)));
    for (std::size_t i = 0; i < std::size(kModes); ++i) {
        const double level = level_near(ring, p.rate, shown.predicted[i], 60);
        levels.push_back(level);
        (kModes[i].at_rest ? rest : moving) = std::fmax(kModes[i].at_rest ? rest : moving, level);
    }
    results["figures"] = {{"levels_db", levels}, {"at_rest_below_moving_db", moving - rest}};
}

void add(CLI::App& demo, Common& common, const char* name, const char* what, double dx, double dy) {
    Exhibit e;
    e.stage.name = name;
    e.stage.seconds = 1.5;
    e.stage.step = 1.0 / 480;
    e.stage.ear[0] = 0.15;
    e.stage.ear[1] = -0.25;
    e.stage.ear[2] = 0.35;
    e.title = what;
    e.top = 4000;
    e.choice = {"auto", "explicit", "modal"};
    add_exhibit(
        demo, common, e, what,
        "Mathematics: clamped square plate, f = lambda / (2 pi a^2) sqrt(D / (rho h)), "
        "lambda =\n35.99, 73.41, 108.27, 131.64, 132.25, 165.15 (Leissa); 300 x 300 x 3 mm "
        "of steel, struck by\na ball of 10 g at 0.5 m/s.\n\n"
        "Expected: those lines; after a blow on the centre the modes with a node line "
        "through it\n(73.41, 108.27, 165.15) 30 dB and more below the others.",
        [dx, dy](scenes::World& world, const Exhibit& own) { return build(world, own, dx, dy); },
        judge);
}

} // namespace

void add_demo_plate(CLI::App& demo, Common& common) {
    add(demo, common, "plate-center", "A clamped square plate is struck on its centre", 0, 0);
    add(demo, common, "plate-off", "A clamped square plate is struck off its centre", 0.25, 0.17);
}

} // namespace softsound
