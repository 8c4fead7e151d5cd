// The two sheets (P01): a ball dropped on a nearly rigid sheet bounces and rolls off; on a
// compliant one it sinks in.
//
// Mathematics. sheet-stiff: steel, 300 x 300 x 3 mm, held along two sides and tilted by 10 degrees;
// St.Venant-Kirchhoff. sheet-soft: rubber, 4 mm, held along its border; stable neo-Hookean. The
// ball is ODE's, 40 mm wide, and meets the surface by a penalty and Coulomb friction.
//
// Command. softsound demo sheet-stiff, softsound demo sheet-soft
//
// Expected. The first rings at every bounce, then rolls, and ends with the ball beyond the edge;
// the second thuds, and bears the ball some thicknesses deep.

#include "softsound/demo.h"
#include "softsound/exhibit.h"

#include <algorithm>
#include <cmath>

namespace softsound {
namespace {

constexpr double kSide = 0.3, kRadius = 0.02; // [m]

struct Ball {
    dBodyID body = nullptr;
    double lowest = 1, edge = 0; ///< [m]
    double left_at = -1;         ///< [s]; -1: not yet
};
std::shared_ptr<Ball> dropped;

dBodyID add_ball(scenes::World& world, double mass, double x, double z) {
    const dBodyID body = dBodyCreate(world.ode());
    dMass m;
    dMassSetSphereTotal(&m, mass, kRadius);
    dBodySetMass(body, &m);
    dGeomSetBody(dCreateSphere(world.space(), kRadius), body);
    dBodySetPosition(body, x, 0.01, z);
    return body;
}

Shown build_stiff(scenes::World& world, const Exhibit& e) {
    constexpr double kTilt = 0.175; // [rad]
    Shown shown = show(
        world, e,
        ode::soft::MeshHandle(scenes::made(dSoftMeshCreatePlate(kSide, kSide, 3e-3, 12, 12, 1))),
        preset("steel"), "steel");
    const dQuaternion tilt = {std::cos(kTilt / 2), 0, std::sin(kTilt / 2), 0}; // +x goes down
    dSoftBodyRotate(shown.body, tilt);
    hold(shown, [](const dReal* p) { return std::abs(p[1]) > kSide / 2 - 1e-9; });
    dropped = std::make_shared<Ball>();
    dropped->body = add_ball(world, 0.1, -0.05, 0.05 * std::tan(kTilt) + kRadius + 0.08);
    dropped->edge = kSide / 2 * std::cos(kTilt);
    shown.drive = [ball = dropped](double t) {
        const dReal* at = dBodyGetPosition(ball->body);
        ball->lowest = std::fmin(ball->lowest, at[2]);
        if (ball->left_at < 0 && at[0] > ball->edge)
            ball->left_at = t;
    };
    return shown;
}

void judge_stiff(nlohmann::ordered_json& results, const Performance& p, const Shown&) {
    const auto loudness = [&](double from, double to) {
        double sum = 0;
        const auto first = static_cast<std::size_t>(from * p.rate);
        const auto last = std::min(p.left.size(), static_cast<std::size_t>(to * p.rate));
        for (std::size_t i = first; i < last; ++i)
            sum += static_cast<double>(p.left[i]) * static_cast<double>(p.left[i]);
        return 10 * std::log10(sum / static_cast<double>(std::max<std::size_t>(1, last - first)) +
                               1e-30);
    };
    results["figures"] = {
        {"rolled_off_at_s", dropped->left_at},
        {"impact_rms_db_pa", loudness(0.12, 0.3)},
        {"rolling_rms_db_pa", loudness(dropped->left_at - 0.1, dropped->left_at)}};
}

Shown build_soft(scenes::World& world, const Exhibit& e) {
    constexpr double kThickness = 4e-3; // [m]
    dSoftSolid solid = dSoftSolidDefault();
    solid.young = 1e6;
    solid.poisson = 0.45;
    solid.density = 1100;
    solid.alpha = 5;
    solid.beta = 3e-4;
    Shown shown = show(world, e,
                       ode::soft::MeshHandle(
                           scenes::made(dSoftMeshCreatePlate(kSide, kSide, kThickness, 16, 16, 1))),
                       solid, "rubber of 1 MPa");
    if (!dSoftBodySetMaterialModel(shown.body, "stable-neo-hookean"))
        throw scenes::Refused("model");
    hold(shown, [](const dReal* p) {
        return std::fmax(std::abs(p[0]), std::abs(p[1])) > kSide / 2 - 1e-9;
    });
    dropped = std::make_shared<Ball>();
    dropped->body = add_ball(world, 0.2, 0.02, kThickness / 2 + kRadius + 0.2);
    shown.drive = [ball = dropped](double) {
        ball->lowest = std::fmin(ball->lowest, dBodyGetPosition(ball->body)[2]);
    };
    return shown;
}

void judge_soft(nlohmann::ordered_json& results, const Performance&, const Shown&) {
    const double depth = 2e-3 + kRadius - dropped->lowest;
    const double rest = 2e-3 + kRadius - dBodyGetPosition(dropped->body)[2];
    results["figures"] = {
        {"deepest_m", depth}, {"deepest_in_thicknesses", depth / 4e-3}, {"at_the_end_m", rest}};
}

} // namespace

void add_demo_sheet(CLI::App& demo, Common& common) {
    const Exhibit stiff = {.stage = make_stage("sheet-stiff", 1.5, 1.0 / 480, {0, -0.5, 0.5}),
                           .title = "ball on a tilted sheet of steel",
                           .choice = {"auto", "explicit", "modal", "cubic"}};
    add_exhibit(
        demo, common, stiff, "A ball bounces on a nearly rigid sheet and rolls off",
        "Mathematics: 300 x 300 x 3 mm of steel, held along two sides, tilted by 10 degrees; "
        "a\nball of 100 g falls 8 cm on it.\n\n"
        "Expected: a ring at every bounce, then rolling, then nothing once the ball is over "
        "the\nedge (figures: rolled_off_at_s).",
        build_stiff, judge_stiff);
    Exhibit soft = stiff;
    soft.stage.name = "sheet-soft";
    soft.stage.seconds = 2;
    soft.title = "ball on a sheet of rubber";
    soft.top = 1500;
    soft.tier = "explicit"; // it is stretched far beyond what modes know
    soft.order = 1;
    soft.choice.clear();
    add_exhibit(
        demo, common, soft, "A ball sinks into a compliant sheet",
        "Mathematics: 300 x 300 x 4 mm of rubber (1 MPa, stable neo-Hookean), held along its "
        "border;\na ball of 200 g falls 20 cm on it. Moves node by node: modes know no such "
        "stretch.\n\n"
        "Expected: a thud below 200 Hz; the ball goes some thicknesses deep and comes to rest "
        "in the\nhollow.",
        build_soft, judge_soft);
}

} // namespace softsound
