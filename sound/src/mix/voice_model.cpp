#include "mix/voice_model.h"

#include "source/node_rule.h"

#include <cmath>
#include <cstdio>
#include <numbers>

namespace ode::sound {
namespace {

bool solves(const Settings& settings) { return settings.radiation == Radiation::kTransfer; }

Leaning leaning_of(const Settings& settings) {
    return hears_modes(settings) ? radiation_leaning(settings.radiation) : Leaning::kCarried;
}

TransferTable make_table(const ModalSurface& surface, const Settings& settings) {
    const Air& air = settings.air;
    if (!solves(settings))
        return node_table(surface, leaning_of(settings), air, settings.send_rate());
    TransferOptions options;
    options.density = air.density;
    options.speed = air.speed;
    return make_transfer_table(surface, options);
}

/// All that make_table() reads but the surface.
std::string rule_of(const Settings& settings) {
    char text[128];
    const Air& air = settings.air;
    if (solves(settings))
        std::snprintf(text, sizeof text, "transfer %a %a", air.density, air.speed);
    else
        std::snprintf(text, sizeof text, "nodes %d %a %a %a",
                      static_cast<int>(leaning_of(settings)), air.density, air.speed,
                      settings.send_rate());
    return text;
}

} // namespace

std::vector<double> mode_levels(const TransferTable& table, std::span<const double> omega) {
    std::vector<double> level(omega.size(), 0.0);
    std::vector<ModeGain> gain(omega.size());
    const double distance = 1.0 + table.near_limit(); // [m]
    for (int side = 0; side < 6; ++side) {
        Vec3 way = Vec3::Zero();
        way[side / 2] = side % 2 == 0 ? distance : -distance;
        table.gains(table.centre + way, gain);
        for (std::size_t k = 0; k < level.size(); ++k)
            level[k] += (std::pow(static_cast<double>(gain[k].acceleration), 2) +
                         std::pow(static_cast<double>(gain[k].velocity) / omega[k], 2)) *
                        distance * distance / 6.0;
    }
    for (double& own : level)
        own = std::sqrt(own);
    return level;
}

bool hears_modes(const Settings& settings) noexcept {
    return settings.sampling == Sampling::kSinc && (settings.radiation == Radiation::kMonopole ||
                                                    settings.radiation == Radiation::kKirchhoff ||
                                                    settings.radiation == Radiation::kTransfer);
}

std::shared_ptr<const StruckVoiceModel>
make_voice_model(std::span<const double> omega, std::span<const double> decay,
                 const BoundaryMesh& mesh, std::span<const double> shape, const Settings& settings,
                 const TableCache& cache) {
    auto model = std::make_shared<StruckVoiceModel>();
    model->omega.assign(omega.begin(), omega.end());
    model->decay.assign(decay.begin(), decay.end());
    const Air& air = settings.air;
    if (!omega.empty()) {
        ModalSurface surface;
        surface.mesh = mesh;
        surface.shape.assign(shape.begin(), shape.end());
        for (const double w : omega)
            surface.frequency.push_back(w / (2.0 * std::numbers::pi));
        model->table =
            cache.get(surface, rule_of(settings), [&] { return make_table(surface, settings); });
    } else {
        model->table.centre = mesh.centre();
        model->table.radius = mesh.radius(model->table.centre);
        model->table.speed = air.speed;
    }
    model->rigid = rigid_sound(mesh, Vec3::Zero(), air);
    model->level = mode_levels(model->table, model->omega);
    find_steps(*model, settings.rate);
    return model;
}

SurfaceNumbers::SurfaceNumbers(std::span<const int> given, std::size_t nodes) {
    std::vector<int> own(nodes, -1);
    triangle.resize(given.size() / 3);
    for (std::size_t t = 0; t < triangle.size(); ++t)
        for (std::size_t c = 0; c < 3; ++c) {
            const auto n = static_cast<std::size_t>(given[3 * t + c]);
            if (own[n] < 0) {
                own[n] = static_cast<int>(node.size());
                node.push_back(static_cast<int>(n));
            }
            triangle[t][c] = own[n];
        }
}

} // namespace ode::sound
