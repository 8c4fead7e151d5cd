// The crinkled sheet (P01): a slightly bowed sheet is bent back and forth by two moving clamps, and
// snaps through.
//
// Mathematics. A sheet of plastic, 200 x 80 x 2 mm, bowed by 8 mm; its short ends are nailed to two
// kinematic bodies of ODE's that turn against each other by a third of a radian at 4 Hz. The bow
// has two stable sides; each half turn forces it from one to the other, faster than the clamps
// move. Linear elements, node by node: large rotations are not in a body's modes.
//
// Command. softsound demo crinkle
//
// Expected. A burst of sound at each snap, two in a period; the middle changes sides as often.

#include "scenes/moved_mesh.h"
#include "softsound/demo.h"
#include "softsound/exhibit.h"

#include <cmath>
#include <numbers>

namespace softsound {
namespace {

constexpr double kLength = 0.2, kWidth = 0.08, kThickness = 2e-3, kBow = 8e-3; // [m]
constexpr double kTurn = 0.33, kRate = 4;                                      // [rad], [Hz]

struct Clamps {
    dBodyID end[2];
    dSoftBodyID sheet;
    int middle = 0;
    int side = 0, changes = 0;
    double fastest = 0; ///< of the middle [m/s]
    double last = 0, step = 0;
};
std::shared_ptr<Clamps> clamped;

ode::soft::MeshHandle bowed() {
    const ode::soft::MeshHandle flat(
        scenes::made(dSoftMeshCreateBar(kLength, kWidth, kThickness, 20, 8, 1)));
    return scenes::moved(
        flat, [](double* x) { x[2] += kBow * std::sin(std::numbers::pi * x[0] / kLength); });
}

Shown build(scenes::World& world, const Exhibit& e) {
    Shown shown = show(world, e, bowed(), preset("plastic"), "plastic");
    clamped = std::make_shared<Clamps>();
    clamped->sheet = shown.body;
    clamped->step = e.stage.step;
    for (int i = 0; i < 2; ++i) {
        const double at = i * kLength;
        const std::vector<int> nodes =
            nodes_where(shown.body, [at](const dReal* p) { return std::abs(p[0] - at) < 1e-9; });
        const dBodyID clamp = dBodyCreate(world.ode());
        dBodySetKinematic(clamp);
        dBodySetPosition(clamp, at, 0, 0);
        if (!dSoftBodyAttachNodes(shown.body, clamp, nodes.data(), static_cast<int>(nodes.size())))
            throw scenes::Refused("nails");
        clamped->end[i] = clamp;
    }
    const std::vector<int> middle = nodes_where(shown.body, [](const dReal* p) {
        return std::abs(p[0] - kLength / 2) < 1e-9 && std::abs(p[1]) < 1e-9;
    });
    clamped->middle = middle.at(0);
    shown.drive = [c = clamped](double t) {
        // The turn so far is -A sin(w t) of the left end about y, the other against it.
        const double w = 2 * std::numbers::pi * kRate;
        const double spin = kTurn * w * std::cos(w * (t + c->step / 2));
        dBodySetAngularVel(c->end[0], 0, spin, 0);
        dBodySetAngularVel(c->end[1], 0, -spin, 0);
        const dReal* x = nullptr;
        int stride = 0;
        dSoftBodyGetPositions(c->sheet, &x, &stride);
        const double z = x[static_cast<std::ptrdiff_t>(c->middle) * stride + 2];
        if (t > 0)
            c->fastest = std::fmax(c->fastest, std::abs(z - c->last) / c->step);
        c->last = z;
        constexpr double kClear = 2e-3; // [m]
        const int side = z > kClear ? 1 : z < -kClear ? -1 : c->side;
        c->changes += c->side != 0 && side != c->side;
        c->side = side;
    };
    return shown;
}

void judge(nlohmann::ordered_json& results, const Performance& p, const Shown&) {
    // Loudness in stretches of 5 ms, and how often it rises 10 dB above the median.
    const auto length = static_cast<std::size_t>(0.005 * p.rate);
    std::vector<double> loud;
    for (std::size_t first = 0; first + length <= p.left.size(); first += length) {
        double sum = 0;
        for (std::size_t i = 0; i < length; ++i)
            sum += static_cast<double>(p.left[first + i]) * static_cast<double>(p.left[first + i]);
        loud.push_back(10 * std::log10(sum / static_cast<double>(length) + 1e-30));
    }
    std::vector<double> sorted = loud;
    std::nth_element(sorted.begin(), sorted.begin() + std::ssize(sorted) / 2, sorted.end());
    const double median = sorted[sorted.size() / 2];
    results["figures"] = {
        {"changes_of_side", clamped->changes},
        {"fastest_m_s", clamped->fastest},
        {"loudest_over_median_db", *std::max_element(loud.begin(), loud.end()) - median}};
}

} // namespace

void add_demo_crinkle(CLI::App& demo, Common& common) {
    const Exhibit e = {.stage = make_stage("crinkle", 0.8, 1.0 / 960, {0.1, -0.3, 0.3}),
                       .title = "bowed sheet of plastic, bent back and forth",
                       .tier = "explicit",
                       .order = 1,
                       .ring_from = 0};
    add_exhibit(
        demo, common, e, "A bowed sheet snaps between moving clamps",
        "Mathematics: 200 x 80 x 2 mm of plastic, bowed by 8 mm; its ends are nailed to "
        "kinematic\nbodies of ODE's that turn by a third of a radian at 4 Hz. Moves node by "
        "node.\n\n"
        "Expected: a burst at each snap, two a period; figures: how often the middle "
        "changed sides.",
        build, judge);
}

} // namespace softsound
