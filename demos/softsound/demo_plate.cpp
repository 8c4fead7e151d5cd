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
// Expected. Partials within 6 cents of Leissa's (40 cells a side, narrower at the rim; with --cells
// 20 it is 60 cents: quadratic elements five times as wide as they are thick are too stiff in
// bending, however many lie through the thickness). After the blow on the centre the modes (1,2),
// (2,2), (2,3) lie 30 dB and more below where the other blow leaves them.

#include "scenes/mallet.h"
#include "scenes/plate.h"
#include "softsound/demo.h"
#include "softsound/exhibit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace softsound {
namespace {

constexpr double kSide = scenes::kPlateSide, kThickness = scenes::kPlateThickness;
constexpr int kCells = 40;
// Leissa's, and whether a line through the centre is at rest.
constexpr struct {
    double lambda;
    bool at_rest;
} kModes[] = {{35.99, false},  {73.41, true},   {108.27, true},
              {131.64, false}, {132.25, false}, {165.15, true}};

Shown build(scenes::World& world, const Exhibit& e, double dx, double dy) {
    const dSoftSolid solid = preset("steel");
    dWorldSetGravity(world.ode(), 0, 0, 0);
    Shown shown = show(world, e, scenes::graded_plate(e.cells), solid, "steel");
    hold(shown, [](const dReal* p) {
        return std::fmax(std::abs(p[0]), std::abs(p[1])) > kSide / 2 - 1e-9;
    });
    constexpr double kRadius = 0.01, kSpeed = 0.3, kFlight = 0.02; // [m], [m/s], [s]
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
    const Exhibit e = {.stage = make_stage(name, 1.5, 1.0 / 480, {0.15, -0.25, 0.35}),
                       .title = what,
                       .top = 4000,
                       .cells = kCells,
                       .choice = {"auto", "explicit", "modal", "cubic"}};
    add_exhibit(
        demo, common, e, what,
        "Mathematics: clamped square plate, f = lambda / (2 pi a^2) sqrt(D / (rho h)), "
        "lambda =\n35.99, 73.41, 108.27, 131.64, 132.25, 165.15 (Leissa); 300 x 300 x 3 mm "
        "of steel, struck by\na ball of 10 g at 0.3 m/s.\n\n"
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
