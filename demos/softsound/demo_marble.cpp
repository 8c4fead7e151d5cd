// A glass marble rolls on a steel plate between two wooden rims. Rigid bodies of ODE.
//
// Mathematics. The contact reads the heights of both surfaces at the speed at which it rolls; the
// marble rides over them on Hertz's spring, m z'' = k (y - z), k = (6 E*^2 N R)^(1/3), and the
// force that this takes, no more than its weight, drives the plate's modes where it is, and jolts
// the marble. Waves of 1 mm are cut in a band of the plate's table for the figure: passed at v they
// hum at v / 1 mm. Loudness falls with the speed, as the waves that pass come slower.
//
// Command. softsound demo marble
//
// Expected. A rumble with the plate's modes in it, a line at speed / wavelength, a knock at each
// rim and a slower rumble after it.

#include "plots/spectrogram.h"
#include "softsound/demo.h"
#include "softsound/ringers.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace softsound {
namespace {

constexpr double kSide = 0.24, kWide = 0.12, kThick = 0.004, kRadius = 0.008; // [m]
constexpr double kSpeed = 0.6, kWave = 1e-3;                                  // [m/s], [m]
constexpr double kRim = 0.01;                                                 // [m]

/// Heights of the plate: random, and waves of kWave upon them.
std::vector<dReal> heights() {
    constexpr std::size_t kPoints = 32768, kPerWave = 32;
    std::vector<dReal> out(kPoints);
    double rough = 0;
    unsigned state = 12345;
    for (std::size_t i = 0; i < kPoints; ++i) {
        state = 1664525u * state + 1013904223u;
        rough = 0.995 * rough + 0.3e-8 * (state / 2147483648.0 - 1);
        out[i] =
            rough + 0.3e-6 * std::sin(2 * std::numbers::pi * static_cast<double>(i) / kPerWave);
    }
    return out;
}

struct Watch {
    dBodyID marble;
    std::vector<double> speed; ///< at each step [m/s]
};

RingerScene build(scenes::World& world, const std::shared_ptr<Watch>& watch) {
    RingerScene scene;
    const dSoftSolid steel = solid_of("steel"), glass = solid_of("glass"), wood = solid_of("wood");
    const dVector3 size = {kSide, kWide, kThick}, at = {0, 0, -kThick / 2};
    Ringer plate{
        "plate", box_of(world, steel, size, at),
        ode::soft::MeshHandle(scenes::made(dSoftMeshCreateBox(kSide, kWide, kThick, 12, 6, 1))),
        steel};
    const dJointID nail = dJointCreateFixed(world.ode(), nullptr);
    dJointAttach(nail, plate.body, nullptr);
    dJointSetFixed(nail);
    const dGeomID floor = dBodyGetFirstGeom(plate.body);
    scene.ringer.push_back(std::move(plate));
    std::vector<dGeomID> rim;
    for (const double side : {-1.0, 1.0}) {
        rim.push_back(dCreateBox(world.space(), kRim, kWide, 3 * kRim));
        dGeomSetPosition(rim.back(), side * 0.5 * (kSide + kRim), 0, 0.5 * kRim);
    }
    // Sunk in by as much, what rolls keeps touch; ODE's steps let it hop otherwise.
    dWorldSetContactSurfaceLayer(world.ode(), 1e-4);
    const dVector3 start = {-0.1, 0.02, kRadius};
    watch->marble = ball_of(world, glass, kRadius, start);
    dBodySetLinearVel(watch->marble, kSpeed, 0, 0);
    dBodySetAngularVel(watch->marble, 0, kSpeed / kRadius, 0);
    scene.ringer.push_back({"marble", watch->marble,
                            ode::soft::MeshHandle(scenes::made(dSoftMeshCreateSphere(kRadius, 2))),
                            glass});
    const dGeomID round = dBodyGetFirstGeom(watch->marble);
    scene.tell = [floor, rim, wood, round](dSoundWorldID sound) {
        const std::vector<dReal> height = heights();
        dSoundSurface rough = dSoundSurfaceDefault();
        rough.count = static_cast<int>(height.size());
        rough.profile = height.data();
        rough.spacing = kWave / 32;
        dSoundSetGeomSurface(sound, floor, &rough);
        dSoundSurface smooth = dSoundSurfaceDefault();
        smooth.roughness = 1e-8; // of glass
        dSoundSetGeomSurface(sound, round, &smooth);
        for (const dGeomID own : rim)
            dSoundSetGeomSolid(sound, own, &wood);
    };
    scene.drive = [watch](double) {
        watch->speed.push_back(std::fabs(dBodyGetLinearVel(watch->marble)[0]));
    };
    return scene;
}

void judge(nlohmann::ordered_json& results, const Performance& p, const Watch& watch) {
    // The first way across: steady.
    constexpr double kFrom = 0.1, kTo = 0.3;
    const auto first = static_cast<std::size_t>(kFrom * p.rate);
    const auto last = std::min(p.left.size(), static_cast<std::size_t>(kTo * p.rate));
    const plots::Spectrogram s =
        plots::spectrum(std::span(p.left).subspan(first, last - first), p.rate);
    const double speed = watch.speed[static_cast<std::size_t>(
        0.2 * static_cast<double>(watch.speed.size()) / p.seconds)];
    const double expected = speed / kWave;
    const auto bin = [&](double f) { return static_cast<std::size_t>(f / s.row_height); };
    const auto top =
        std::max_element(s.level.begin() + static_cast<std::ptrdiff_t>(bin(0.9 * expected)),
                         s.level.begin() + static_cast<std::ptrdiff_t>(bin(1.1 * expected)));
    results["figures"] = {{"speed_at_first", speed},
                          {"speed_at_the_end", watch.speed.back()},
                          {"line_expected_hz", expected},
                          {"line_hz", static_cast<double>(top - s.level.begin()) * s.row_height},
                          {"rms_at_first", rms(p, kFrom, kTo)},
                          {"rms_at_the_end", rms(p, p.seconds - 0.2, p.seconds)}};
}

} // namespace

void add_demo_marble(CLI::App& demo, Common& common) {
    RingerShow show;
    show.stage.name = "marble";
    show.stage.seconds = 3;
    show.stage.step = 1.0 / 480;
    show.stage.ear[1] = -0.2;
    show.stage.ear[2] = 0.4;
    show.stage.full_scale = 0.5;
    show.title = "a marble rolls on a steel plate";
    show.top = 12000;
    auto watch = std::make_shared<Watch>();
    add_ringers(
        demo, common, show, "A marble rolls on a plate",
        "Mathematics: heights read at the speed of rolling; the marble rides on Hertz's spring, "
        "m z'' =\nk (y - z), and the force, no more than its weight, drives the plate's modes.\n\n"
        "Expected: a rumble with the plate's modes in it, a line at speed / 1 mm, a knock at each "
        "rim.",
        [watch](scenes::World& world) { return build(world, watch); },
        [watch](nlohmann::ordered_json& results, const Performance& p) {
            judge(results, p, *watch);
        });
}

} // namespace softsound
