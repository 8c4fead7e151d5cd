// The vibraphone bar (P01): an undercut bar of aluminium at F#3 lies on two soft supports and is
// struck in its middle.
//
// Mathematics. Bending of a free bar of varying thickness, tuned to 1 : 4 : 10
// (scenes/vibraphone.h; bars as measured: 1 : 3.98 : 10.67 and 1 : 4.00 : 9.47, Csound's table).
// Supports: boxes of ODE's under a row of nodes of the mesh, near those of the first mode, that the
// bar lies on by a penalty of 2e7 Pa/m. It sinks in by m g / K and swings as a whole at sqrt(K / m)
// = sqrt(g / sag), 25 Hz; that is heard as loud as a row of dipoles of its known motion says.
// Mallet: a ball of ODE's, 30 g at 1 m/s.
//
// Command. softsound demo vibraphone [--order 1]
//
// Expected. Partials near 185, 745 and 1863 Hz; the swing on the supports below them, within 3 % of
// sqrt(g / sag) / 2 pi and 1.5 dB of its dipoles. On meshes
// of 2 cm and 1 cm the first mode differs by two thirds of an octave with the source paper's linear
// elements, and by a quarter of a semitone with quadratic ones.

#include "scenes/mallet.h"
#include "scenes/vibraphone.h"
#include "softsound/demo.h"
#include "softsound/exhibit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace softsound {
namespace {

constexpr int kFine = 36, kCoarse = 18;      // cells: 1 cm and 2 cm
constexpr double kSoft = 2e7;                // [Pa/m]
constexpr double kLowest = 12, kFirst = 185; // [Hz]
constexpr double kSupport =
    0.08;                     // [m] from the ends: a row of nodes near the nodes of the first mode
constexpr double kWait = 0.3; // [s] it settles
constexpr dVector3 kEar = {0.18, -0.4, 0.5}; // [m]

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

/// Height of the bar's middle, step by step.
struct Rise {
    std::vector<double> z; ///< of its centre of mass, from where it began [m]
};
std::shared_ptr<Rise> risen;

Shown build(scenes::World& world, const Exhibit& e) {
    Shown shown = show(world, e, scenes::vibraphone_bar(kFine), preset("aluminium"), "aluminium");
    auto supports = std::make_shared<Supports>();
    constexpr double kThick = 0.01; // [m]
    for (std::size_t i = 0; i < 2; ++i) {
        const double at = i == 0 ? kSupport : scenes::kVibraphoneLength - kSupport;
        supports->geom[i] = dCreateBox(world.space(), kThick, 2 * scenes::kVibraphoneWidth, kThick);
        dGeomSetPosition(supports->geom[i], at, 0, scenes::vibraphone_underside(at) - kThick / 2);
    }
    dSoftWorldSetContactCallback(world.soft(), &Supports::meet, supports.get());
    constexpr double kRadius = 0.015, kSpeed = 1; // [m], [m/s]
    const dVector3 at = {0.45 * scenes::kVibraphoneLength, 0.005,
                         scenes::kVibraphoneHeight / 2 + kRadius + kSpeed * kWait};
    const dVector3 velocity = {0, 0, -kSpeed};
    auto mallet = std::make_shared<scenes::Mallet>(world, 0.03, kRadius, at, velocity);
    risen = std::make_shared<Rise>();
    dVector3 begin;
    dSoftBodyGetCenterOfMass(shown.body, begin);
    shown.drive = [mallet, supports, rise = risen, body = shown.body, from = begin[2]](double) {
        mallet->watch();
        dVector3 now;
        dSoftBodyGetCenterOfMass(body, now);
        rise->z.push_back(now[2] - from);
    };
    shown.theory = "quadratic, consistent mass";
    shown.predicted = {185.0, 745.3, 1862.5};
    return shown;
}

/// First bending mode of the bar, elements and mesh by choice [Hz].
double first_mode(int cells, int order) {
    scenes::World world;
    const dSoftSolid solid = preset("aluminium");
    const ode::soft::MeshHandle mesh = scenes::vibraphone_bar(cells);
    const dSoftBodyID body = scenes::made(dSoftBodyCreate(world.soft(), mesh, &solid));
    dReal first = 0;
    if (!dSoftBodySetOrder(body, order) || dSoftBodyGetModes(body, 1, &first) != 1)
        throw scenes::Refused("modes");
    return first;
}

double cents(double a, double b) { return 1200 * std::log2(a / b); }

/// How far the bar sinks in: the mean over whole swings before the blow [m].
double sag(const Rise& rise, double step, double period) {
    const auto last = std::min(rise.z.size(), static_cast<std::size_t>(kWait / step));
    const auto whole = static_cast<std::size_t>(std::floor(last * step / period)) * period / step;
    const std::size_t first = last - std::min(last, static_cast<std::size_t>(whole));
    double sum = 0;
    for (std::size_t i = first; i < last; ++i)
        sum -= rise.z[i];
    return sum / static_cast<double>(std::max<std::size_t>(1, last - first));
}

/// What the swing of the bar as a whole sounds like, by its known motion: a row of dipoles along
/// it, rho (A + pi b^2 / 4) z'' a metre (section and the air that a strip of width b carries; Lamb,
/// Hydrodynamics, 71), in the near field p = rho A z'' cos / (4 pi r^2) [Pa].
std::vector<float> sound_of_swing(const Rise& rise, double step, const dVector3 ear, double area) {
    constexpr double kAir = 1.21; // [kg/m^3]
    const double strip = area + std::numbers::pi * std::pow(scenes::kVibraphoneWidth, 2) / 4;
    constexpr int kPieces = 50;
    double gain = 0;
    for (int i = 0; i < kPieces; ++i) {
        const double x = (i + 0.5) / kPieces * scenes::kVibraphoneLength - ear[0];
        const double r = std::sqrt(x * x + ear[1] * ear[1] + ear[2] * ear[2]);
        gain += kAir * strip * ear[2] / (4 * std::numbers::pi * r * r * r) *
                scenes::kVibraphoneLength / kPieces;
    }
    std::vector<float> out;
    for (std::size_t i = 1; i + 1 < rise.z.size(); ++i)
        out.push_back(static_cast<float>(gain * (rise.z[i + 1] - 2 * rise.z[i] + rise.z[i - 1]) /
                                         (step * step)));
    return out;
}

void judge(nlohmann::ordered_json& results, const Performance& p, const Shown& shown) {
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
    const double step = results["step"];
    const double sunk = sag(*risen, step, 1 / swing);
    const double mean_area =
        dSoftBodyGetMass(shown.body) / (shown.solid.density * scenes::kVibraphoneLength);
    const std::vector<float> known = sound_of_swing(*risen, step, kEar, mean_area);
    const auto struck = std::min(known.size(), static_cast<std::size_t>(0.35 / step));
    const double expected = level_near(std::span(known).subspan(struck), 1 / step, swing, 100);
    results["figures"] = {
        {"tuning",
         {1, nearest(745) / modes[0].get<double>(), nearest(1863) / modes[0].get<double>()}},
        {"supports_hz", swing},
        {"sag_m", sunk},
        {"supports_expected_hz", std::sqrt(9.81 / sunk) / (2 * std::numbers::pi)},
        {"supports_over_expected", swing * 2 * std::numbers::pi * std::sqrt(sunk / 9.81)},
        {"supports_level_db", level},
        {"supports_level_expected_db", expected},
        {"supports_level_off_db", level - expected},
        {"supports_below_first_mode_db", level_near(ring, p.rate, modes[0]) - level},
        {"meshes_differ_linear_cents", cents(first_mode(kCoarse, 1), first_mode(kFine, 1))},
        {"meshes_differ_quadratic_cents", cents(first_mode(kCoarse, 2), first_mode(kFine, 2))}};
}

} // namespace

void add_demo_vibraphone(CLI::App& demo, Common& common) {
    const Exhibit e = {.stage = make_stage("vibraphone", 2, 1.0 / 480, {kEar[0], kEar[1], kEar[2]}),
                       .title = "vibraphone bar, F#3, on soft supports",
                       // "auto" takes what lies on something node by node, for ten times the time
                       .tier = "modal",
                       .top = 5000,
                       .ring_from = 0.35,
                       .choice = {"auto", "explicit", "modal", "cubic"}};
    add_exhibit(
        demo, common, e, "A vibraphone bar on soft supports is struck",
        "Mathematics: bending of a free bar, undercut to 1 : 4 : 10 at F#3 (185 Hz); boxes of "
        "ODE's\nsupport it softly (2e7 Pa/m) 80 mm from its ends; a ball of 30 g strikes it "
        "at 1 m/s.\n\n"
        "Expected: partials near 185, 745, 1863 Hz, the swing on the supports below the "
        "first;\nmeshes of 2 and 1 cm are two thirds of an octave apart with linear\nelements, and "
        "a quarter of a semitone with quadratic ones.",
        build, judge);
}

} // namespace softsound
