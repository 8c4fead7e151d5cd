// A xylophone played by balls: eight wooden bars lie on felt at the nodes of their first mode, and
// plastic balls fall on them one after the other. Rigid bodies of ODE.
//
// Mathematics. Bars of one section, tuned by Timoshenko's beam with free ends, f1 ~ thickness /
// length^2; modes of each as a solid. A ball of 7.7 g strikes at 1.4 m/s for Hertz's contact time.
// The felt bears the bar and takes from each mode by the share of its energy that is in the felt's
// springs (ode_sound/surface.h): least from the first, whose nodes it lies under.
//
// Command. softsound demo xylophone
//
// Expected. A scale from C5 to C6, each note within 5 cents of its theory, dying away in a tenth of
// a second or two, as wood does.

#include "plots/partials.h"
#include "scenes/timoshenko.h"
#include "softsound/demo.h"
#include "softsound/ringers.h"

#include <array>
#include <cmath>

namespace softsound {
namespace {

constexpr std::array<double, 8> kNote = {523.25, 587.33, 659.26, 698.46,
                                         783.99, 880.00, 987.77, 1046.50}; // [Hz]
constexpr double kWidth = 0.03, kThick = 0.012, kApart = 0.045;            // [m]
constexpr double kBall = 0.012, kFall = 0.1;                               // radius, height [m]
constexpr double kFirst = 0.3, kBeat = 0.25, kStays = 0.06;                // [s]

double length_of(const dSoftSolid& wood, double note) {
    double low = 0.05, high = 1;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        const ode::soft::TimoshenkoBar bar{middle,     kWidth,       kThick,
                                           wood.young, wood.poisson, wood.density};
        (bar.frequencies(ode::soft::BeamEnds::kFree, 1)[0] > note ? low : high) = middle;
    }
    return low;
}

double strikes_at(std::size_t note) {
    return kFirst + kBeat * static_cast<double>(note) + std::sqrt(2 * kFall / 9.81);
}

RingerScene build(scenes::World& world) {
    RingerScene scene;
    const dSoftSolid wood = solid_of("wood"), plastic = solid_of("plastic");
    std::vector<dGeomID> felt, ball_geom;
    std::vector<dBodyID> ball;
    for (std::size_t i = 0; i < kNote.size(); ++i) {
        const double length = length_of(wood, kNote[i]), y = kApart * static_cast<double>(i);
        const dVector3 size = {length, kWidth, kThick}, at = {0, y, kThick / 2};
        const int along = static_cast<int>(std::lround(length / 0.025));
        Ringer bar{"bar " + std::to_string(i + 1), box_of(world, wood, size, at),
                   ode::soft::MeshHandle(
                       scenes::made(dSoftMeshCreateBox(length, kWidth, kThick, along, 1, 1))),
                   wood, kNote[i]};
        scene.ringer.push_back(std::move(bar));
        for (const double side : {-1.0, 1.0}) {
            felt.push_back(dCreateBox(world.space(), 0.006, kWidth, 0.01));
            dGeomSetPosition(felt.back(), side * (0.5 - 0.2242) * length, y, -0.005);
        }
        const dVector3 waits = {1, y, 1};
        ball.push_back(ball_of(world, plastic, kBall, waits));
        dBodyDisable(ball.back());
        ball_geom.push_back(dBodyGetFirstGeom(ball.back()));
    }
    scene.tell = [felt, ball_geom, plastic](dSoundWorldID sound) {
        dSoftSolid soft = dSoftSolidDefault();
        soft.young = 5e6;
        soft.poisson = 0.2;
        dSoundSurface surface = dSoundSurfaceDefault();
        surface.loss = 0.8;
        for (const dGeomID own : felt) {
            dSoundSetGeomSolid(sound, own, &soft);
            dSoundSetGeomSurface(sound, own, &surface);
        }
        for (const dGeomID own : ball_geom)
            dSoundSetGeomSolid(sound, own, &plastic);
    };
    scene.drive = [ball, next = std::size_t{0}, gone = std::size_t{0}](double time) mutable {
        if (next < ball.size() && time >= kFirst + kBeat * static_cast<double>(next)) {
            // Beside the middle: it moves most there, and the second mode is heard, too.
            dBodySetPosition(ball[next], 0.02, kApart * static_cast<double>(next),
                             kThick + kBall + kFall);
            dBodyEnable(ball[next++]);
        }
        if (gone < next && time >= strikes_at(gone) + kStays) {
            dBodySetPosition(ball[gone], 1, kApart * static_cast<double>(gone), 1);
            dBodyDisable(ball[gone++]);
        }
    };
    return scene;
}

void judge(nlohmann::ordered_json& results, const Performance& p) {
    double worst = 0;
    int heard = 0;
    auto notes = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < kNote.size(); ++i) {
        const double from = strikes_at(i) + 0.02;
        const auto first = static_cast<std::size_t>(from * p.rate);
        const auto count = static_cast<std::size_t>(0.15 * p.rate);
        if (first + count > p.left.size())
            break;
        const std::array<double, 1> line = {kNote[i]};
        const auto found =
            plots::find_partials(std::span(p.left).subspan(first, count), p.rate, line, 100, 10);
        if (found.empty())
            continue;
        ++heard;
        const double off = ode::soft::cents(found[0].measured, kNote[i]);
        notes.push_back(off);
        worst = std::max(worst, std::fabs(off));
    }
    results["figures"] = {
        {"notes_heard", heard}, {"notes_off_cents", notes}, {"worst_cents", worst}};
}

} // namespace

void add_demo_xylophone(CLI::App& demo, Common& common) {
    RingerShow show;
    show.stage.name = "xylophone";
    show.stage.seconds = 2.8;
    show.stage.step = 1.0 / 480;
    show.stage.ear[1] = -0.5;
    show.stage.ear[2] = 0.6;
    show.stage.full_scale = 2;
    show.title = "xylophone, C5 to C6, played by balls";
    show.top = 8000;
    add_ringers(
        demo, common, show, "A xylophone is played by falling balls",
        "Mathematics: wooden bars tuned by Timoshenko's beam with free ends, on felt at the "
        "nodes of\ntheir first mode; modes of each as a solid, struck for Hertz's contact "
        "time, damped by the\nwood and by the share of their energy in the felt.\n\n"
        "Expected: a scale from C5 to C6, each note within 5 cents of its theory.",
        build, judge);
}

} // namespace softsound
