#include "bridge/rigid_model.h"

#include "bridge/kept_tables.h"
#include "mix/voice_model.h"
#include "transfer/coarsen.h"

#include <ode_softbody/softbody.hpp>

#include <algorithm>
#include <cstring>
#include <numbers>
#include <stdexcept>

namespace ode::sound {
namespace {

/// Nodes and elements as the application gave them.
void read(dSoftMeshID mesh, std::vector<double>& node, std::vector<int>& element) {
    const dReal* x = nullptr;
    const int* tet = nullptr;
    const int nodes = dSoftMeshGetNodes(mesh, &x), tets = dSoftMeshGetElements(mesh, &tet);
    const int corners = dSoftMeshGetOrder(mesh) == 2 ? 10 : 4;
    node.assign(x, x + 3 * static_cast<std::ptrdiff_t>(nodes));
    element.assign(tet, tet + corners * static_cast<std::ptrdiff_t>(tets));
}

std::shared_ptr<const RigidModel> make(dSoftMeshID given, const dSoftSolid& solid) {
    const soft::MeshHandle mesh(dSoftMeshCreateQuadratic(given));
    const int* triangle = nullptr;
    const int triangles = mesh ? dSoftMeshGetTriangles(mesh, &triangle) : 0;
    if (triangles == 0)
        return nullptr;
    dSoftModesOptions options = dSoftModesOptionsDefault();
    const soft::ModesHandle modes(dSoftModesCompute(mesh, &solid, 1, nullptr, 0, &options));
    dSoftModesInfo info{};
    info.struct_size = sizeof info;
    if (!modes || !dSoftModesGetInfo(modes, &info))
        return nullptr;

    auto model = std::make_shared<RigidModel>();
    model->elastic = {solid.young, solid.poisson};
    model->mass = info.mass;
    model->volume = info.volume;
    model->centre = Vec3(info.center);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            model->inertia(i, j) = info.inertia[i][j];
    const dReal *frequency = nullptr, *t60 = nullptr, *position = nullptr;
    const int count = dSoftModesGetFrequencies(modes, &frequency);
    dSoftModesGetT60(modes, &t60);
    const int nodes = dSoftMeshGetNodes(mesh, &position);
    SurfaceNumbers own({triangle, 3 * static_cast<std::size_t>(triangles)},
                       static_cast<std::size_t>(nodes));
    std::vector<Vec3> node;
    for (const int n : own.node)
        node.emplace_back(Vec3(position + 3 * n) - model->centre);
    if (!is_closed({node, own.triangle}))
        throw std::invalid_argument(
            "the mesh's surface is open: parts touch along an edge or at a corner only; join them "
            "by faces, or leave one out");
    model->low = model->high = node.front();
    for (const Vec3& x : node) {
        model->low = model->low.cwiseMin(x);
        model->high = model->high.cwiseMax(x);
    }
    for (int k = 0; k < count; ++k) {
        model->omega.push_back(2.0 * std::numbers::pi * frequency[k]);
        model->decay.push_back(dSoftDecayFromT60(t60[k]));
        const dReal* shape = nullptr;
        int stride = 0;
        dSoftModesGetShape(modes, k, &shape, &stride);
        for (const int n : own.node)
            for (int axis = 0; axis < 3; ++axis)
                model->shape.push_back(shape[stride * n + axis]);
    }
    model->omega_floats.assign(model->omega.begin(), model->omega.end());
    model->surface = StruckSurface(std::move(node), std::move(own.triangle), model->shape);
    return model;
}

} // namespace

std::shared_ptr<const RigidModel> RigidModels::find(dSoftMeshID mesh, const dSoftSolid& solid) {
    std::erase_if(entry_, [](const Entry& own) { return own.model.expired(); });
    Entry entry{};
    entry.solid = dSoftSolidDefault();
    std::memcpy(&entry.solid, &solid, std::min<std::size_t>(solid.struct_size, sizeof solid));
    read(mesh, entry.node, entry.element);
    for (const Entry& own : entry_)
        if (own.node == entry.node && own.element == entry.element &&
            std::memcmp(&own.solid, &entry.solid, sizeof solid) == 0)
            return own.model.lock();
    std::shared_ptr<const RigidModel> made = make(mesh, entry.solid);
    if (made) {
        entry.model = made;
        entry_.push_back(std::move(entry));
    }
    return made;
}

std::shared_ptr<const StruckVoiceModel>
RigidModels::voice(const std::shared_ptr<const RigidModel>& model, const Settings& settings) {
    const auto found = std::find_if(entry_.begin(), entry_.end(),
                                    [&](const Entry& own) { return own.model.lock() == model; });
    if (found->voice)
        return found->voice;
    BoundaryMesh mesh;
    mesh.node.assign(model->surface.nodes().begin(), model->surface.nodes().end());
    mesh.triangle.assign(model->surface.triangles().begin(), model->surface.triangles().end());
    auto made =
        make_voice_model(model->omega, model->decay, mesh, model->shape, settings, kept_tables());
    found->voice = made;
    return made;
}

void RigidModels::forget_voices() noexcept {
    for (Entry& own : entry_)
        own.voice.reset();
}

} // namespace ode::sound
