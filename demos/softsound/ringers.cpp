#include "softsound/ringers.h"

#include "plots/partials.h"
#include "plots/sound_picture.h"
#include "scenes/timoshenko.h"
#include "softsound/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

namespace softsound {
namespace {

std::vector<double> modes_of(dSoundModalID voice) {
    std::vector<double> out(
        static_cast<std::size_t>(dSoundModalGetModes(voice, 0, nullptr, nullptr)));
    dSoundModalGetModes(voice, static_cast<int>(out.size()), out.data(), nullptr);
    return out;
}

nlohmann::ordered_json as_json(const Ringer& own) {
    dSoundModalStatus status = {};
    status.struct_size = sizeof status;
    dSoundModalGetStatus(own.voice, &status);
    const std::vector<double> modes = modes_of(own.voice);
    nlohmann::ordered_json out = {{"name", own.name},
                                  {"mass", status.mass},
                                  {"modes", status.modes},
                                  {"blows", status.blows}};
    if (!modes.empty())
        out["lowest"] = modes.front();
    if (own.theory > 0) {
        out["theory"] = own.theory;
        out["cents"] = ode::soft::cents(modes.front(), own.theory);
    }
    return out;
}

void summarise(const nlohmann::ordered_json& r, const RingerShow& show) {
    for (const auto& own : r["bodies"]) {
        std::printf("%s: %.4g kg, %d modes, %d blows", own["name"].get<std::string>().c_str(),
                    own["mass"].get<double>(), own["modes"].get<int>(), own["blows"].get<int>());
        if (own.contains("lowest"))
            std::printf(", lowest %.1f Hz", own["lowest"].get<double>());
        if (own.contains("cents"))
            std::printf(" (theory %+.1f cents)", own["cents"].get<double>());
        std::printf("\n");
    }
    for (const auto& [name, value] : r["figures"].items())
        std::printf("  %s: %s\n", name.c_str(), value.dump().c_str());
    std::printf("time: %.3f CPU seconds per simulated second, %.1f %% of it audio\n",
                r["cpu_seconds_per_second"].get<double>(), 100 * r["audio_share"].get<double>());
    std::printf("level: peak %.3g Pa\nsound in %s\n", r["peak"].get<double>(),
                show.stage.out.c_str());
}

int run(const RingerShow& show, const BuildRingers& build, const JudgeRingers& judge,
        const Common& common) {
    scenes::World world;
    RingerScene scene = build(world);
    nlohmann::ordered_json bodies = nlohmann::ordered_json::array();
    std::vector<double> lines;
    Act act;
    act.begin = [&](dSoundWorldID sound) {
        if (scene.tell)
            scene.tell(sound);
        Progress progress("modes", static_cast<double>(scene.ringer.size()), common.quiet);
        for (std::size_t i = 0; i < scene.ringer.size(); ++i) {
            Ringer& own = scene.ringer[i];
            progress.at(static_cast<double>(i));
            own.voice = scenes::made(dSoundModalCreate(own.body, own.mesh, &own.solid));
            for (const double f : modes_of(own.voice))
                lines.push_back(f);
        }
    };
    act.before_step = scene.drive;
    act.end = [&] {
        for (const Ringer& own : scene.ringer)
            bodies.push_back(as_json(own));
    };
    const Performance p = perform(world, show.stage, common.quiet, act);
    nlohmann::ordered_json results = {
        {"demo", show.stage.name}, {"step", show.stage.step}, {"bodies", bodies}};
    results.update(softsound::as_json(p));
    results["out"] = show.stage.out;
    judge(results, p);
    if (!show.stage.plot.empty()) {
        std::sort(lines.begin(), lines.end());
        std::erase_if(lines, [&](double f) { return f > show.top; });
        const plots::SoundPicture picture{show.title, p.left, static_cast<double>(p.rate), lines,
                                          show.top};
        if (const std::string why = plots::draw(picture, show.stage.plot); why.empty())
            results["plot"] = show.stage.plot;
        else
            std::cerr << "softsound: no picture: " << why << '\n';
    }
    if (common.summarises())
        summarise(results, show);
    write_json(common, results);
    return 0;
}

dBodyID body_of(scenes::World& world, const dMass& mass, dGeomID geom, const dVector3 at) {
    const dBodyID body = dBodyCreate(world.ode());
    dBodySetMass(body, &mass);
    dGeomSetBody(geom, body);
    dBodySetPosition(body, at[0], at[1], at[2]);
    return body;
}

} // namespace

void add_ringers(CLI::App& demo, Common& common, const RingerShow& show, const std::string& what,
                 const std::string& about, BuildRingers build, JudgeRingers judge) {
    auto own = std::make_shared<RingerShow>(show);
    CLI::App& command = *demo.add_subcommand(own->stage.name, what);
    command.footer(about);
    add_stage(command, own->stage);
    command.add_option("--step", own->stage.step, "Of ODE [s]")
        ->check(CLI::Range(5e-4, 0.02))
        ->capture_default_str();
    add_common(command, common);
    command.callback([own, &common, build = std::move(build), judge = std::move(judge)] {
        if (common.json.empty())
            common.json = own->stage.name + ".json";
        common.action = [own, &common, build, judge] { return run(*own, build, judge, common); };
    });
}

dBodyID box_of(scenes::World& world, const dSoftSolid& solid, const dVector3 size,
               const dVector3 at) {
    dMass mass;
    dMassSetBox(&mass, solid.density, size[0], size[1], size[2]);
    return body_of(world, mass, dCreateBox(world.space(), size[0], size[1], size[2]), at);
}

dBodyID ball_of(scenes::World& world, const dSoftSolid& solid, double radius, const dVector3 at) {
    dMass mass;
    dMassSetSphere(&mass, solid.density, radius);
    return body_of(world, mass, dCreateSphere(world.space(), radius), at);
}

dSoftSolid solid_of(const char* name) {
    dSoftSolid solid = dSoftSolidDefault();
    if (!dSoftSolidPreset(name, &solid))
        throw scenes::Refused(name);
    return solid;
}

double rms(const Performance& p, double from, double to) {
    const auto first = static_cast<std::size_t>(from * p.rate);
    const auto last = std::min(p.left.size(), static_cast<std::size_t>(to * p.rate));
    double sum = 0;
    for (std::size_t i = first; i < last; ++i)
        sum += static_cast<double>(p.left[i]) * static_cast<double>(p.left[i]);
    return last > first ? std::sqrt(sum / static_cast<double>(last - first)) : 0;
}

} // namespace softsound
