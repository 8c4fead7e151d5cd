// Dice and coins fall on a stone table: rigid bodies of ODE, of which the dice are too small to
// ring.
//
// Mathematics. A die's first mode lies at the edge of hearing; what is heard is the air that it
// pushes as it is jolted (acceleration noise): a dipole, filtered as a sphere's of the same
// strength, p = d/dt [r . D V / r^2 + r . D V' / (r c)]. A coin is a free disc: f = lambda^2 / (2
// pi R^2) sqrt(D / (rho h)), lambda^2 = 5.26 (A. W. Leissa, Vibration of Plates, table 2.6, nu
// 0.33), less some per cent since it is thick.
//
// Command. softsound demo dice
//
// Expected. Two dice click; three coins ring near 8 kHz, chatter and wobble, and all is silent in
// the end.

#include "softsound/demo.h"
#include "softsound/ringers.h"

#include <cmath>
#include <numbers>

namespace softsound {
namespace {

constexpr double kDie = 0.016, kCoin = 0.013, kThick = 0.0018; // side, radius [m]
constexpr double kSettled = 0.4;                               // at the end [s]

/// A disc: a square of elements drawn out to its circumcircle. Round faces are rebuilt by the
/// library from their facets.
ode::soft::MeshHandle disc(double radius, double thickness) {
    const ode::soft::MeshHandle square(
        scenes::made(dSoftMeshCreateBox(2, 2, thickness, 10, 10, 1)));
    const dReal* x = nullptr;
    const int* tet = nullptr;
    const int nodes = dSoftMeshGetNodes(square, &x), tets = dSoftMeshGetElements(square, &tet);
    std::vector<dReal> node(x, x + 3 * static_cast<std::ptrdiff_t>(nodes));
    for (std::size_t i = 0; i < node.size(); i += 3) {
        const double u = node[i], v = node[i + 1];
        node[i] = radius * u * std::sqrt(1 - 0.5 * v * v);
        node[i + 1] = radius * v * std::sqrt(1 - 0.5 * u * u);
    }
    return ode::soft::MeshHandle(scenes::made(dSoftMeshCreate(node.data(), nodes, tet, tets)));
}

double disc_mode(const dSoftSolid& solid, double radius, double thickness) {
    const double stiffness = solid.young * thickness * thickness /
                             (12 * (1 - solid.poisson * solid.poisson) * solid.density);
    return 5.26 / (2 * std::numbers::pi * radius * radius) * std::sqrt(stiffness);
}

void throw_it(dBodyID body, double turn, double speed) {
    dQuaternion q = {std::cos(turn), 0.6 * std::sin(turn), 0.8 * std::sin(turn), 0};
    dBodySetQuaternion(body, q);
    dBodySetLinearVel(body, 0.4 * std::cos(5 * turn), 0.4 * std::sin(5 * turn), -speed);
    dBodySetAngularVel(body, 20 * std::sin(3 * turn), 15 * std::cos(2 * turn), 5);
    dBodySetAutoDisableFlag(body, 1);
}

RingerScene build(scenes::World& world) {
    RingerScene scene;
    const dSoftSolid plastic = solid_of("plastic"), brass = solid_of("brass");
    dCreatePlane(world.space(), 0, 0, 1, 0);
    dWorldSetERP(world.ode(), 0.4);
    for (int i = 0; i < 2; ++i) {
        const dVector3 size = {kDie, kDie, kDie}, at = {0.06 * i - 0.1, 0, 0.15 + 0.05 * i};
        Ringer die{
            i == 0 ? "die 1" : "die 2", box_of(world, plastic, size, at),
            ode::soft::MeshHandle(scenes::made(dSoftMeshCreateBox(kDie, kDie, kDie, 2, 2, 2))),
            plastic};
        throw_it(die.body, 0.7 + i, 0.5);
        scene.ringer.push_back(std::move(die));
    }
    for (int i = 0; i < 3; ++i) {
        dMass mass;
        dMassSetCylinder(&mass, brass.density, 3, kCoin, kThick);
        const dBodyID body = dBodyCreate(world.ode());
        dBodySetMass(body, &mass);
        dGeomSetBody(dCreateCylinder(world.space(), kCoin, kThick), body);
        dBodySetPosition(body, 0.06 * i, 0.05, 0.25 + 0.06 * i);
        dBodySetDamping(body, 1e-3, 5e-3); // of the air, and of rolling
        throw_it(body, 0.3 + 0.5 * i, 0.3);
        scene.ringer.push_back({"coin " + std::to_string(i + 1), body, disc(kCoin, kThick), brass,
                                disc_mode(brass, kCoin, kThick)});
    }
    return scene;
}

void judge(nlohmann::ordered_json& results, const Performance& p) {
    unsigned long dice = 0, coins = 0;
    for (const auto& own : results["bodies"])
        (own["name"].get<std::string>().front() == 'd' ? dice : coins) +=
            own["blows"].get<unsigned long>();
    results["figures"] = {{"blows_of_dice", dice},
                          {"blows_of_coins", coins},
                          {"rms_at_first", rms(p, 0.1, 0.8)},
                          {"rms_at_the_end", rms(p, p.seconds - kSettled, p.seconds)}};
}

} // namespace

void add_demo_dice(CLI::App& demo, Common& common) {
    RingerShow show;
    show.stage.name = "dice";
    show.stage.seconds = 3.5;
    show.stage.step = 1.0 / 1000;
    show.stage.ear[1] = -0.3;
    show.stage.ear[2] = 0.4;
    show.stage.full_scale = 2;
    show.title = "two dice and three coins on a stone table";
    show.top = 22000;
    add_ringers(demo, common, show, "Dice and coins fall on a table",
                "Mathematics: dice are too small to ring and click by the air that they jolt, a "
                "dipole as a\nsphere's of the same strength; a coin rings as a free disc, f = "
                "5.26 / (2 pi R^2) sqrt(D / (rho h)).\n\n"
                "Expected: clicks, rings near 8 kHz, chatter, and silence in the end.",
                build, judge);
}

} // namespace softsound
