// The pendulum (P01): a bar on a hinge of ODE's swings after the blow of a fast weight, and rings.
//
// Mathematics. A pinned-free bar, f = b^2 / (2 pi L^2) sqrt(E I / (rho A)), tan b = tanh b, b =
// 3.9266: near 500 Hz. It swings at its small-angle period 2 pi sqrt(2 L / (3 g)) and somewhat
// slower for its amplitude. Nodes at its upper end are nailed to a body of ODE's that hangs on a
// hinge of the world. Each part of it sounds at f (1 + v / c) and from a face that turns; the ear
// gets the sum. Since the mode has no moment about the hinge, the parts' shifts nearly cancel: what
// is left is a fraction of v / c, worked out here from the swing by a row of dipoles along the bar.
//
// Command. softsound demo pendulum
//
// Expected. The line near 500 Hz goes up and down as the known motion says (figures:
// shift_over_expected and correlation near 1). The bar is nailed to a rigid body, so that it moves
// node by node.

#include "scenes/mallet.h"
#include "softsound/demo.h"
#include "softsound/exhibit.h"

#include <cmath>
#include <complex>
#include <numbers>

namespace softsound {
namespace {

constexpr double kLength = 0.27, kWidth = 0.03, kThickness = 0.01; // [m]
constexpr double kEar = 0.8, kEarHeight = -0.15;                   // [m] in front, from the hinge

/// How the bar swung, step by step.
struct Swing {
    dSoftBodyID bar;
    double step;
    std::vector<double> angle; ///< of its centre of mass about the hinge, from hanging [rad]
};
std::shared_ptr<Swing> recorded;

Shown build(scenes::World& world, const Exhibit& e) {
    const dSoftSolid solid = preset("aluminium");
    Shown shown = show(world, e,
                       ode::soft::MeshHandle(
                           scenes::made(dSoftMeshCreateBar(kLength, kWidth, kThickness, 13, 1, 1))),
                       solid, "aluminium");
    const std::vector<int> top =
        nodes_where(shown.body, [](const dReal* p) { return std::abs(p[0]) < 1e-9; });
    const double quarter = std::numbers::pi / 4;
    const dQuaternion down = {std::cos(quarter), 0, std::sin(quarter), 0}; // x to -z, z to x
    dSoftBodyRotate(shown.body, down);
    dSoftBodySetPosition(shown.body, 0, 0, -kLength / 2);
    const dBodyID holder = dBodyCreate(world.ode());
    dMass mass;
    dMassSetBoxTotal(&mass, 0.01, kThickness, kWidth, 0.02);
    dBodySetMass(holder, &mass);
    const dJointID hinge = dJointCreateHinge(world.ode(), nullptr);
    dJointAttach(hinge, holder, nullptr);
    dJointSetHingeAnchor(hinge, 0, 0, 0);
    dJointSetHingeAxis(hinge, 0, 1, 0);
    if (!dSoftBodyAttachNodes(shown.body, holder, top.data(), static_cast<int>(top.size())))
        throw scenes::Refused("nails");
    constexpr double kRadius = 0.01, kSpeed = 3, kFlight = 0.02; // [m], [m/s], [s]
    const dVector3 at = {kThickness / 2 + kRadius + kSpeed * kFlight, 0, -0.2};
    const dVector3 velocity = {-kSpeed, 0, 0};
    auto mallet = std::make_shared<scenes::Mallet>(world, 0.05, kRadius, at, velocity);
    recorded = std::make_shared<Swing>(Swing{shown.body, e.stage.step, {}});
    shown.drive = [mallet, swing = recorded](double) {
        mallet->watch();
        dVector3 centre;
        dSoftBodyGetCenterOfMass(swing->bar, centre);
        swing->angle.push_back(std::atan2(centre[0], -centre[2]));
    };
    shown.theory = "pinned-free";
    for (const double b : {3.92660, 7.06858})
        shown.predicted.push_back(b * b / (2 * std::numbers::pi * kLength * kLength) * kThickness /
                                  std::sqrt(12.0) * std::sqrt(solid.young / solid.density));
    return shown;
}

struct Track {
    std::vector<double> time, shift, level; ///< [s], relative, [-]
};

/// Frequency and strength of the line at `f`, by its phase over windows of 60 ms.
Track follow(std::span<const float> sound, double rate, double f, double from, double to) {
    Track out;
    const auto length = static_cast<std::size_t>(0.06 * rate);
    const double hop = 0.01;
    std::complex<double> before = 0;
    double mean = 0;
    for (double t = from; t + 0.06 < to; t += hop) {
        std::complex<double> sum = 0;
        const auto first = static_cast<std::size_t>(t * rate);
        for (std::size_t i = 0; i < length && first + i < sound.size(); ++i) {
            const double window =
                0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(i) /
                                     static_cast<double>(length));
            sum +=
                window * static_cast<double>(sound[first + i]) *
                std::polar(1.0, -2 * std::numbers::pi * f * static_cast<double>(first + i) / rate);
        }
        if (before != 0.0) {
            out.time.push_back(t + 0.03 - hop / 2);
            out.shift.push_back(std::arg(sum / before) / (2 * std::numbers::pi * hop * f));
            out.level.push_back(std::abs(sum));
            mean += out.shift.back();
        }
        before = sum;
    }
    for (double& shift : out.shift)
        shift -= mean / static_cast<double>(out.shift.size());
    return out;
}

/// Angle at a time, without the bar's vibration [rad].
double angle_at(const Swing& swing, double time) {
    constexpr std::ptrdiff_t kReach = 5; // steps: 20 ms
    const auto middle = static_cast<std::ptrdiff_t>(time / swing.step);
    double sum = 0;
    int count = 0;
    for (std::ptrdiff_t i = middle - kReach; i <= middle + kReach; ++i)
        if (i >= 0 && i < std::ssize(swing.angle)) {
            sum += swing.angle[static_cast<std::size_t>(i)];
            ++count;
        }
    return sum / std::max(count, 1);
}

/// Phase at the ear of what the first mode sends from all along the bar when that is at an angle: a
/// row of dipoles along its normal, phi(s) = sin(b s / L) + (sin b / sinh b) sinh(b s / L).
double phase_at(double angle, double frequency) {
    constexpr double kRoot = 3.92660, kSpeed = 343;
    const double k = 2 * std::numbers::pi * frequency / kSpeed;
    constexpr int kPoints = 200;
    std::complex<double> sum = 0;
    for (int i = 0; i < kPoints; ++i) {
        const double s = (i + 0.5) / kPoints;
        const double mode =
            std::sin(kRoot * s) + std::sin(kRoot) / std::sinh(kRoot) * std::sinh(kRoot * s);
        const double x = kEar - kLength * s * std::sin(angle);
        const double z = kEarHeight + kLength * s * std::cos(angle);
        const double r = std::hypot(x, z);
        const double facing = (x * std::cos(angle) + z * std::sin(angle)) / r;
        sum += mode * facing / r * std::complex<double>(1, -1 / (k * r)) * std::polar(1.0, -k * r);
    }
    return std::arg(sum);
}

/// Relative change of the line's frequency that the bar's known motion makes at the ear.
double expected_shift(const Swing& swing, double time, double frequency) {
    constexpr double kHalf = 5e-3, kSpeed = 343; // [s], [m/s]
    const double sent = time - kEar / kSpeed;
    double turn = phase_at(angle_at(swing, sent + kHalf), frequency) -
                  phase_at(angle_at(swing, sent - kHalf), frequency);
    turn = std::remainder(turn, 2 * std::numbers::pi);
    return turn / (2 * std::numbers::pi * 2 * kHalf * frequency);
}

void judge(nlohmann::ordered_json& results, const Performance& p, const Shown& shown) {
    double line = shown.predicted[0];
    for (const auto& partial : results["theory_partials"])
        if (std::abs(partial["predicted"].get<double>() - line) < 1)
            line = partial["measured"];
    constexpr double kFrom = 0.1;
    const Track track = follow(p.left, p.rate, line, kFrom, p.seconds);
    if (track.time.empty())
        return; // too short to follow anything
    std::vector<double> known;
    double mean = 0;
    for (const double t : track.time) {
        known.push_back(expected_shift(*recorded, t, line));
        mean += known.back() / static_cast<double>(track.time.size());
    }
    double xy = 0, xx = 0, yy = 0, most = 0;
    for (std::size_t i = 0; i < known.size(); ++i) {
        const double x = known[i] - mean;
        most = std::fmax(most, std::abs(x));
        xy += x * track.shift[i];
        xx += x * x;
        yy += track.shift[i] * track.shift[i];
    }
    const auto [low, high] = std::minmax_element(track.level.begin(), track.level.end());
    results["figures"] = {
        {"line_hz", line},
        {"period_s", 2 * std::numbers::pi * std::sqrt(2 * kLength / (3 * 9.81))},
        {"largest_angle_rad", *std::max_element(recorded->angle.begin(), recorded->angle.end())},
        {"largest_shift_expected", most},
        {"shift_over_expected", xy / xx},
        {"correlation", xy / std::sqrt(xx * yy)},
        {"level_range_db", 20 * std::log10(*high / *low)}};
}

} // namespace

void add_demo_pendulum(CLI::App& demo, Common& common) {
    Exhibit e;
    e.stage.name = "pendulum";
    e.stage.seconds = 1.2;
    e.stage.step = 1.0 / 480;
    e.stage.ear[0] = kEar;
    e.stage.ear[1] = 0;
    e.stage.ear[2] = kEarHeight;
    e.title = "bar on a hinge, struck, swinging";
    e.top = 4000;
    e.ring_from = 0.05;
    e.tier = "explicit"; // nailed to a rigid body: there is no other
    add_exhibit(
        demo, common, e, "A bar swings on a hinge after a blow",
        "Mathematics: pinned-free bar, f = b^2 / (2 pi L^2) sqrt(E I / (rho A)), b = 3.9266: "
        "near\n500 Hz; the swing's period is 2 pi sqrt(2 L / (3 g)) = 0.85 s and more; each "
        "part of the bar is\nheard at f (1 + v / c), and the mode has no moment about the "
        "hinge, so that little is left of\nthe shift in their sum.\n\n"
        "Expected: the line follows the shift that is worked out from the swing (figures:\n"
        "shift_over_expected, correlation near 1).",
        build, judge);
}

} // namespace softsound
