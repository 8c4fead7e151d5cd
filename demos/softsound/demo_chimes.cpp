// Wind chimes (P02's showpiece): aluminium tubes on threads, struck by a clapper whose sail the
// wind pulls. Rigid bodies of ODE; sound by their vibration modes.
//
// Mathematics. Modes of each tube as a solid, K phi = w^2 M phi (cubic elements); a blow of impulse
// J at a point x gives mode k the push phi_k(x) . J over Hertz's contact time
// 2.87 (m^2/(R E*^2 v))^(1/5); then q'' + 2 d q' + w^2 q = 0, exactly. Tuned by Timoshenko's beam:
// b^2 = rho A L^4 w^2 / (E I), f1 ~ 1/L^2.
//
// Command. softsound demo chimes [--gust 3] [--seconds 20] [--out chimes.wav] [--plot chimes.png]
//          [--json chimes.json] [--live]: Enter is a gust then
//
// Expected. chimes.wav, chimes.png, chimes.json. Strokes every now and then, each a tone of the
// scale with inharmonic partials 1 : 2.76 : 5.4 : 8.9, that rings for some six seconds.

#include "plots/sound_picture.h"
#include "scenes/chimes.h"
#include "scenes/measured_chimes.h"
#include "softsound/demo.h"
#include "softsound/performance.h"
#include "softsound/progress.h"

#include <cmath>
#include <cstdio>
#include <iostream>
#include <poll.h>
#include <unistd.h>

namespace softsound {
namespace {

constexpr const char* kAbout =
    "Aluminium tubes on threads, tuned to a scale, a clapper in their middle, a sail in the "
    "wind.\n\n"
    "Mathematics: each tube's modes as a solid, K phi = w^2 M phi; a blow J at x pushes mode k by\n"
    "phi_k(x) . J over Hertz's contact time; it then rings by its exact solution and is heard\n"
    "through the pressure that its surface makes. Theory: Timoshenko's beam with free ends.\n\n"
    "Expected: tones with partials 1 : 2.76 : 5.4 : 8.9 whenever the clapper strikes, ringing for\n"
    "some six seconds. --live: press Enter for a gust. The modes are found at the first run, in\n"
    "a minute, and kept.";

constexpr std::size_t kPartials = 4;
constexpr double kTop = 20000; // [Hz]

struct Options {
    scenes::Chimes chimes;
    int tubes = 6;
    Stage stage;
};

/// Bending modes come in pairs, one in each of two planes; others don't.
std::vector<double> bending(dSoundModalID voice) {
    std::vector<double> all(
        static_cast<std::size_t>(dSoundModalGetModes(voice, 0, nullptr, nullptr)));
    dSoundModalGetModes(voice, static_cast<int>(all.size()), all.data(), nullptr);
    std::vector<double> out;
    for (std::size_t k = 0; k + 1 < all.size(); ++k)
        if (ode::soft::cents(all[k + 1], all[k]) < 1)
            out.push_back(all[k++]);
    return out;
}

/// A gust at each Enter, for two seconds.
class Keys {
public:
    bool gusts(double time) {
        pollfd in{STDIN_FILENO, POLLIN, 0};
        char typed[64];
        if (open_ && poll(&in, 1, 0) > 0) {
            open_ = read(STDIN_FILENO, typed, sizeof typed) > 0;
            if (open_)
                until_ = time + 2;
        }
        return time < until_;
    }

private:
    bool open_ = isatty(STDIN_FILENO) != 0;
    double until_ = 0;
};

nlohmann::ordered_json tube_json(const scenes::ChimeBodies::Tube& tube, dSoundModalID voice) {
    const std::vector<double> theory = tube.theory.frequencies(kPartials);
    const std::vector<double> modes = bending(voice);
    dSoundModalStatus status = {};
    status.struct_size = sizeof status;
    dSoundModalGetStatus(voice, &status);
    nlohmann::ordered_json out = {
        {"length", tube.theory.length}, {"modes", status.modes}, {"blows", status.blows}};
    for (std::size_t k = 0; k < std::min(kPartials, modes.size()); ++k) {
        out["partials"].push_back(modes[k]);
        out["theory"].push_back(theory[k]);
        out["cents"].push_back(ode::soft::cents(modes[k], theory[k]));
    }
    return out;
}

/// Real chimes against the same theory that tunes these.
nlohmann::ordered_json measured_json() {
    const ode::soft::MeasuredChimes set;
    nlohmann::ordered_json out = nlohmann::ordered_json::array();
    for (const auto& chime : ode::soft::kMeasuredChimes) {
        const std::vector<double> theory = set.partials(chime[0]);
        nlohmann::ordered_json& tube = out.emplace_back();
        tube["partials"] = chime;
        tube["theory"] = theory;
        for (std::size_t k = 0; k < chime.size(); ++k)
            tube["cents"].push_back(ode::soft::cents(theory[k], chime[k]));
    }
    return out;
}

void summarise(const nlohmann::ordered_json& r, const Performance& p, const Options& o) {
    for (const auto& tube : r["tubes"]) {
        std::printf("tube of %.3f m, %d blows:", tube["length"].get<double>(),
                    tube["blows"].get<int>());
        for (std::size_t k = 0; k < tube["partials"].size(); ++k)
            std::printf(" %.1f Hz (%+.2f cents)", tube["partials"][k].get<double>(),
                        tube["cents"][k].get<double>());
        std::printf("\n");
    }
    for (const auto& tube : r["measured"]) {
        std::printf("measured (NORSIG 2004):");
        for (std::size_t k = 0; k < kPartials; ++k)
            std::printf(" %.0f Hz (theory %+.1f cents)", tube["partials"][k].get<double>(),
                        tube["cents"][k].get<double>());
        std::printf("\n");
    }
    std::printf("time: %.3f CPU seconds per simulated second, %.1f %% of it audio\n",
                p.cpu / p.seconds, 100 * p.sound.seconds / p.cpu);
    std::printf("level: peak %.3g Pa, %.0f dB SPL\nsound in %s\n", p.sound.peak,
                sound_pressure_level(p.sound.peak), o.stage.out.c_str());
    if (p.live_kind == "openal" && p.sound.underruns > 0)
        std::printf("live: %lu gaps\n", p.sound.underruns);
}

int run(Options o, const Common& common) {
    o.chimes.notes.resize(std::min(o.chimes.notes.size(), static_cast<std::size_t>(o.tubes)));
    scenes::World world;
    scenes::ChimeBodies bodies = scenes::build(world, o.chimes);
    const dSoftSolid metal = scenes::chime_metal();
    nlohmann::ordered_json tubes = nlohmann::ordered_json::array();
    std::vector<double> lines;
    std::vector<dSoundModalID> voice;
    Keys keys;
    Act act;
    act.begin = [&](dSoundWorldID sound) {
        dSoftSolid wood = dSoftSolidDefault();
        dSoftSolidPreset("wood", &wood);
        dSoundSetGeomSolid(sound, nullptr, &wood);
        Progress progress("modes of the tubes", static_cast<double>(bodies.tube.size()),
                          common.quiet);
        for (const auto& tube : bodies.tube) {
            progress.at(static_cast<double>(voice.size()));
            voice.push_back(scenes::made(dSoundModalCreate(tube.body, tube.mesh, &metal)));
            for (const double f : bending(voice.back()))
                lines.push_back(f);
        }
    };
    act.before_step = [&](double time) {
        scenes::ChimeBodies now{{}, bodies.clapper, bodies.sail, bodies.gust, bodies.seed};
        if (o.stage.live && keys.gusts(time))
            now.gust = bodies.gust + 4;
        now.blow(time);
    };
    act.end = [&] {
        for (std::size_t i = 0; i < voice.size(); ++i)
            tubes.push_back(tube_json(bodies.tube[i], voice[i]));
    };
    const Performance p = perform(world, o.stage, common.quiet, act);

    nlohmann::ordered_json results = {{"demo", o.stage.name},
                                      {"gust", o.chimes.gust},
                                      {"step", o.stage.step},
                                      {"tubes", tubes},
                                      {"measured", measured_json()}};
    results.update(as_json(p));
    results["out"] = o.stage.out;
    if (!o.stage.plot.empty()) {
        const plots::SoundPicture picture{o.stage.name, p.left, static_cast<double>(p.rate), lines,
                                          kTop};
        if (const std::string why = plots::draw(picture, o.stage.plot); why.empty())
            results["plot"] = o.stage.plot;
        else
            std::cerr << "softsound: no picture: " << why << '\n';
    }
    if (common.summarises())
        summarise(results, p, o);
    write_json(common, results);
    return 0;
}

} // namespace

void add_demo_chimes(CLI::App& demo, Common& common) {
    auto options = std::make_shared<Options>();
    options->stage.name = "chimes";
    options->stage.seconds = 20;
    options->stage.step = 1.0 / 480;
    options->stage.full_scale = 2;
    CLI::App& chimes = *demo.add_subcommand("chimes", "Wind chimes, in real time");
    chimes.footer(kAbout);
    add_stage(chimes, options->stage);
    chimes.add_option("--gust", options->chimes.gust, "Speed of the wind [m/s]")
        ->check(CLI::Range(0.0, 30.0))
        ->capture_default_str();
    chimes.add_option("--tubes", options->tubes, "How many of the scale's six")
        ->check(CLI::Range(1, 6))
        ->capture_default_str();
    chimes.add_option("--seed", options->chimes.seed, "Of the gusts")->capture_default_str();
    chimes.add_option("--step", options->stage.step, "Of ODE [s]")
        ->check(CLI::Range(5e-4, 0.02))
        ->capture_default_str();
    add_action(chimes, common, options->stage.name,
               [options, &common] { return run(*options, common); });
}

} // namespace softsound
