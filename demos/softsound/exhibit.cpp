#include "softsound/exhibit.h"

#include "plots/sound_picture.h"
#include "plots/spectrogram.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

namespace softsound {
namespace {

constexpr int kModes = 60;

std::vector<double> modes_of(dSoftBodyID body, double top) {
    std::vector<double> modes(kModes);
    modes.resize(static_cast<std::size_t>(dSoftBodyGetModes(body, kModes, modes.data())));
    std::erase_if(modes, [top](double f) { return f > top; });
    return modes;
}

std::span<const float> ring_of(const Performance& p, double from) {
    const auto first = std::min(p.left.size(), static_cast<std::size_t>(from * p.rate));
    return std::span(p.left).subspan(first);
}

void summarise(const nlohmann::ordered_json& r, const Exhibit& e) {
    std::printf("%s: %d nodes, %d elements of order %d, %d triangles, %.4g kg, substep %.3g s\n",
                e.stage.name.c_str(), r["nodes"].get<int>(), r["elements"].get<int>(),
                r["order"].get<int>(), r["surface_elements"].get<int>(), r["mass"].get<double>(),
                r["substep"].get<double>());
    std::printf("time: %.2f CPU seconds per simulated second, %.1f %% of it audio\n",
                r["cpu_seconds_per_second"].get<double>(), 100 * r["audio_share"].get<double>());
    std::printf("level: peak %.3g Pa\n", r["peak"].get<double>());
    const auto print = [](const nlohmann::ordered_json& partials, const std::string& by) {
        for (std::size_t i = 0; i < std::min<std::size_t>(8, partials.size()); ++i)
            std::printf("  %s %8.1f Hz, heard %8.1f Hz (%+.1f cents)\n", by.c_str(),
                        partials[i]["predicted"].get<double>(),
                        partials[i]["measured"].get<double>(), partials[i]["cents"].get<double>());
    };
    print(r["partials"], "mode of the mesh");
    if (r.contains("theory_partials"))
        print(r["theory_partials"], r["theory"].get<std::string>());
    if (r.contains("figures"))
        for (const auto& [name, value] : r["figures"].items())
            std::printf("  %s: %s\n", name.c_str(), value.dump().c_str());
    std::printf("sound in %s\n", e.stage.out.c_str());
}

} // namespace

nlohmann::ordered_json as_json(const std::vector<plots::Partial>& partials) {
    auto out = nlohmann::ordered_json::array();
    for (const plots::Partial& partial : partials)
        out.push_back({{"predicted", partial.predicted},
                       {"measured", partial.measured},
                       {"cents", 1200 * std::log2(partial.measured / partial.predicted)},
                       {"level_db", partial.level}});
    return out;
}

void shape(dSoftBodyID body, const Exhibit& exhibit) {
    if (!dSoftBodySetOrder(body, exhibit.order) || !dSoftBodySetTier(body, exhibit.tier.c_str()))
        throw scenes::Refused("the body can't be had in this form");
}

Shown show(scenes::World& world, const Exhibit& exhibit, ode::soft::MeshHandle mesh,
           const dSoftSolid& solid, const std::string& material) {
    Shown shown;
    shown.material = material;
    shown.solid = solid;
    shown.elements = dSoftMeshGetElements(mesh, nullptr);
    shown.body = scenes::made(dSoftBodyCreate(world.soft(), mesh, &solid));
    shown.mesh = std::make_shared<ode::soft::MeshHandle>(std::move(mesh));
    shape(shown.body, exhibit);
    return shown;
}

void hold(Shown& shown, const std::function<bool(const dReal*)>& condition) {
    const int nodes = dSoftMeshGetNodes(*shown.mesh, nullptr);
    shown.held = nodes_where(shown.body, condition);
    dSoftBodyPinNodes(shown.body, shown.held.data(), static_cast<int>(shown.held.size()));
    // Nodes that the order has added come after the mesh's own.
    std::erase_if(shown.held, [nodes](int node) { return node >= nodes; });
}

double level_near(std::span<const float> ring, double rate, double frequency, double reach) {
    const plots::Spectrogram s = plots::spectrum(ring, rate);
    const auto bin = [&](double cents) {
        return std::clamp(static_cast<std::size_t>(
                              std::lround(frequency * std::exp2(cents / 1200) / s.row_height)),
                          std::size_t{0}, s.level.size() - 1);
    };
    float most = -300;
    for (std::size_t k = bin(-reach); k <= bin(reach); ++k)
        most = std::max(most, s.level[k]);
    return static_cast<double>(most);
}

int run_exhibit(const Exhibit& e, const Build& build, const Judge& judge, const Common& common) {
    scenes::World world;
    const Shown shown = build(world, e);
    const std::vector<double> modes = modes_of(shown.body, e.top);
    const Performance p = perform(world, e.stage, common.quiet, {{}, shown.drive, {}});
    const std::span<const float> ring = ring_of(p, e.ring_from);

    dSoftStatus status = {};
    status.struct_size = sizeof status;
    dSoftBodyGetStatus(shown.body, &status);
    const dReal* first = nullptr;
    const int* triangle = nullptr;
    int stride = 0;
    nlohmann::ordered_json results = {
        {"demo", e.stage.name},
        {"material", shown.material},
        {"order", dSoftBodyGetOrder(shown.body)},
        {"model", dSoftBodyGetMaterialModel(shown.body)},
        {"tier", dSoftBodyGetTier(shown.body)},
        {"nodes", dSoftBodyGetPositions(shown.body, &first, &stride)},
        {"elements", shown.elements},
        {"surface_elements", dSoftBodyGetTriangles(shown.body, &triangle)},
        {"mass", dSoftBodyGetMass(shown.body)},
        {"step", e.stage.step},
        {"substep", status.substep},
        {"stopped", status.stopped != 0},
        {"modal_share", p.world.body_substeps
                            ? static_cast<double>(p.world.modal_substeps) / p.world.body_substeps
                            : 0},
        {"alarms", p.sound.alarms},
        {"modes", modes},
        {"partials", as_json(plots::find_partials(ring, p.rate, modes))}};
    if (!shown.predicted.empty()) {
        results["theory"] = shown.theory;
        results["theory_partials"] =
            as_json(plots::find_partials(ring, p.rate, shown.predicted, 100));
    }
    if (e.judges_elements && shown.mesh)
        results.update(first_mode(shown.body, *shown.mesh, shown.solid, shown.held));
    results.update(softsound::as_json(p));
    results["out"] = e.stage.out;
    if (judge)
        judge(results, p, shown);
    if (!e.stage.plot.empty()) {
        const plots::SoundPicture picture{e.title, p.left, static_cast<double>(p.rate),
                                          shown.predicted.empty() ? modes : shown.predicted, e.top};
        if (const std::string why = plots::draw(picture, e.stage.plot); why.empty())
            results["plot"] = e.stage.plot;
        else
            std::cerr << "softsound: no picture: " << why << '\n';
    }
    if (common.summarises())
        summarise(results, e);
    write_json(common, results);
    return status.stopped ? 1 : 0;
}

void add_exhibit(CLI::App& demo, Common& common, const Exhibit& exhibit, const std::string& what,
                 const std::string& about, Build build, Judge judge) {
    auto own = std::make_shared<Exhibit>(exhibit);
    CLI::App& command = *demo.add_subcommand(own->stage.name, what);
    command.footer(about);
    add_stage(command, own->stage);
    command.add_option("--order", own->order, "Of the elements: 1 is cheap and sharp, 2 in tune")
        ->check(CLI::IsMember({1, 2}))
        ->capture_default_str();
    if (!own->choice.empty())
        command
            .add_option("--tier", own->tier,
                        "How the body moves: node by node, in its vibration modes, or blows node "
                        "by node and the ring in modes")
            ->check(CLI::IsMember(own->choice))
            ->capture_default_str();
    command.add_option("--step", own->stage.step, "Of ODE [s]")
        ->check(CLI::Range(1e-6, 0.1))
        ->capture_default_str();
    if (own->cells > 0)
        command.add_option("--cells", own->cells, "Of the mesh along its side")
            ->check(CLI::Range(4, 100))
            ->capture_default_str();
    command.add_flag("--judge-elements", own->judges_elements,
                     "Also how far the elements are off in pitch: seconds more");
    add_action(command, common, own->stage.name,
               [own, &common, build = std::move(build), judge = std::move(judge)] {
                   return run_exhibit(*own, build, judge, common);
               });
}

} // namespace softsound
