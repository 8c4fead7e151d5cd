// The vibraphone bar (P01): an undercut bar of aluminium at F#3 lies on two soft supports and is
// struck in its middle.
//
// Mathematics. Bending of a free bar of varying thickness, tuned to 1 : 4 : 10
// (scenes/vibraphone.h; bars as measured: 1 : 3.98 : 10.67 and 1 : 4.00 : 9.47, Csound's table).
// Supports: boxes of ODE's below the nodes of the first mode, 0.224 L from the ends, that the bar
// lies on by a penalty of 2e7 Pa/m, so that bar and supports swing at some tens of hertz. Mallet: a
// ball of ODE's, 30 g at 1 m/s.
//
// Command. softsound demo vibraphone [--order 1]
//
// Expected. Partials near 185, 745 and 1863 Hz, and the swing on the supports below them. On meshes
// of 2 cm and 1 cm the first mode differs by two thirds of an octave with the source paper's linear
// elements, and by a quarter of a semitone with quadratic ones.

#include "scenes/mallet.h"
#include "scenes/vibraphone.h"
#include "softsound/demo.h"
#include "softsound/exhibit.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace softsound {
namespace {

constexpr int kFine = 36, kCoarse = 18;      // cells: 1 cm and 2 cm
constexpr double kSoft = 2e7;                // [Pa/m]
constexpr double kLowest = 12, kFirst = 185; // [Hz]

struct Supports {
    std::array<dGeomID, 2> geom;
    static int meet(void* self, dGeomID, dGeomID rigid, dSoftContact* contact) {
        for (const dGeomID own : static_cast<Supports*>(self)->geom)
            if (rigid == own) {
                contact->stiffness = kSoft;
                contact->damping = 1e-4;
            }
        return 1;
    }
};

dSoftSolid aluminium() {
    dSoftSolid solid = dSoftSolidDefault();
    if (!dSoftSolidPreset("aluminium", &solid))
        throw scenes::Refused("material");
    return solid;
}

Shown build(scenes::World& world, const Exhibit& e) {
    Shown shown;
    shown.material = "aluminium";
    const dSoftSolid solid = aluminium();
    const ode::soft::MeshHandle mesh = scenes::vibraphone_bar(kFine);
    shown.elements = dSoftMeshGetElements(mesh, nullptr);
    shown.body = scenes::made(dSoftBodyCreate(world.soft(), mesh, &solid));
    shape(shown.body, e);
    auto supports = std::make_shared<Supports>();
    constexpr double kThick = 0.01; // [m]
    for (std::size_t i = 0; i < 2; ++i) {
        const double at = scenes::kVibraphoneLength * (i == 0 ? 0.224 : 0.776);
        supports->geom[i] = dCreateBox(world.space(), kThick, 2 * scenes::kVibraphoneWidth, kThick);
        dGeomSetPosition(supports->geom[i], at, 0, -scenes::kVibraphoneHeight / 2 - kThick / 2);
    }
    dSoftWorldSetContactCallback(world.soft(), &Supports::meet, supports.get());
    constexpr double kRadius = 0.015, kSpeed = 1, kWait = 0.3; // [m], [m/s], [s] it settles
    const dVector3 at = {0.45 * scenes::kVibraphoneLength, 0.005,
                         scenes::kVibraphoneHeight / 2 + kRadius + kSpeed * kWait};
    const dVector3 velocity = {0, 0, -kSpeed};
    auto mallet = std::make_shared<scenes::Mallet>(world, 0.03, kRadius, at, velocity);
    shown.drive = [mallet, supports](double) { mallet->watch(); };
    shown.theory = "quadratic, consistent mass";
    shown.predicted = {185.0, 745.3, 1862.5};
    return shown;
}

/// First bending mode of the bar, elements and mesh by choice [Hz].
double first_mode(int cells, int order) {
    scenes::World world;
    const dSoftSolid solid = aluminium();
    const ode::soft::MeshHandle mesh = scenes::vibraphone_bar(cells);
    const dSoftBodyID body = scenes::made(dSoftBodyCreate(world.soft(), mesh, &solid));
    dReal first = 0;
    if (!dSoftBodySetOrder(body, order) || dSoftBodyGetModes(body, 1, &first) != 1)
        throw scenes::Refused("modes");
    return first;
}

double cents(double a, double b) { return 1200 * std::log2(a / b); }

void judge(nlohmann::ordered_json& results, const Performance& p, const Shown&) {
    const auto& modes = results["modes"];
    const auto nearest = [&](double f) {
        double best = 1e9;
        for (const auto& m : modes)
            if (std::abs(m.get<double>() - f) < std::abs(best - f))
                best = m.get<double>();
        return best;
    };
    const auto ring =
        std::span(p.left).subspan(std::min(p.left.size(), static_cast<std::size_t>(0.35 * p.rate)));
    double swing = kLowest, level = -300;
    for (double f = kLowest; f < 0.8 * kFirst; f *= 1.02)
        if (const double here = level_near(ring, p.rate, f, 20); here > level) {
            level = here;
            swing = f;
        }
    results["figures"] = {
        {"tuning",
         {1, nearest(745) / modes[0].get<double>(), nearest(1863) / modes[0].get<double>()}},
        {"supports_hz", swing},
        {"supports_below_first_mode_db", level_near(ring, p.rate, modes[0]) - level},
        {"meshes_differ_linear_cents", cents(first_mode(kCoarse, 1), first_mode(kFine, 1))},
        {"meshes_differ_quadratic_cents", cents(first_mode(kCoarse, 2), first_mode(kFine, 2))}};
}

} // namespace

void add_demo_vibraphone(CLI::App& demo, Common& common) {
    Exhibit e;
    e.stage.name = "vibraphone";
    e.stage.seconds = 2;
    e.stage.step = 1.0 / 480;
    e.stage.ear[0] = 0.18;
    e.stage.ear[1] = -0.4;
    e.stage.ear[2] = 0.5;
    e.title = "vibraphone bar, F#3, on soft supports";
    e.top = 5000;
    e.ring_from = 0.35;
    e.tier = "modal"; // "auto" takes what lies on something node by node, for ten times the time
    e.choice = {"auto", "explicit", "modal"};
    add_exhibit(
        demo, common, e, "A vibraphone bar on soft supports is struck",
        "Mathematics: bending of a free bar, undercut to 1 : 4 : 10 at F#3 (185 Hz); boxes of "
        "ODE's\nsupport it softly (2e7 Pa/m) 0.224 L from its ends; a ball of 30 g strikes it "
        "at 1 m/s.\n\n"
        "Expected: partials near 185, 745, 1863 Hz, the swing on the supports below the "
        "first;\nmeshes of 2 and 1 cm are two thirds of an octave apart with linear\nelements, and "
        "a quarter of a semitone with quadratic ones.",
        build, judge);
}

} // namespace softsound
