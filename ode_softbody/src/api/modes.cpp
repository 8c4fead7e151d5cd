#include "api/boundary.h"
#include "api/handles.h"
#include "api/solid.h"
#include "api/versioned.h"
#include "modal/block_lanczos.h"
#include "modal/cache.h"
#include "modal/modal_decay.h"
#include "modal/to_tolerance.h"
#include "model/damping.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

struct dxSoftModes {
    ode::soft::TolerantModes result;
    int nodes = 0, elements = 0; ///< of the mesh as given
    std::vector<double> t60;     ///< [s]
    ode::soft::LiveId<dxSoftModes> id{*this};
};

namespace ode::soft {
namespace {

const dxSoftModes* live(dSoftModesID id, const char* function) noexcept {
    return live_as<dxSoftModes>(id, function, "set of modes");
}

std::size_t positive(int value, const char* name) {
    if (value < 0)
        throw InputError(format("%s is %d: it can't be negative", name, value));
    return static_cast<std::size_t>(value);
}

ModalOptions modal_options(const dSoftModesOptions& c) {
    ModalOptions o;
    o.order = c.order;
    o.mass = c.lumped ? MassKind::kLumped : MassKind::kConsistent;
    o.max_modes = positive(c.count, "count");
    o.max_frequency = c.max_frequency;
    if (o.max_modes > 0 && c.max_frequency > 0 && std::isinf(c.max_frequency))
        o.max_frequency = 1e9; // finite, and above the modes of anything with atoms
    if (c.progress)
        o.progress = [progress = c.progress, data = c.progress_data](const ModalProgress& p) {
            return progress(data, p.stage, p.share, static_cast<int>(p.modes)) != 0;
        };
    return o;
}

ToleranceOptions tolerance_options(const dSoftModesOptions& c) {
    ToleranceOptions t;
    if (!(c.tolerance >= 0) || !std::isfinite(c.tolerance))
        throw InputError(
            format("the tolerance is %g cents: it must be finite and not negative", c.tolerance));
    t.cents = c.tolerance;
    t.partials = positive(c.tolerance_count, "tolerance_count");
    t.max_nodes = positive(c.max_nodes, "max_nodes");
    t.rebuild_curves = c.rebuilt_curves != 0;
    if (c.use_cache)
        t.cache = cache_directory();
    return t;
}

int give(const std::vector<double>& values, const dReal** first) noexcept {
    if (first)
        *first = values.data();
    return static_cast<int>(values.size());
}

} // namespace
} // namespace ode::soft

using namespace ode::soft;

static_assert(sizeof(dReal) == sizeof(double), "modes are handed out without a copy");

dSoftModesOptions dSoftModesOptionsDefault(void) {
    dSoftModesOptions c{};
    c.struct_size = sizeof c;
    c.order = 3;
    c.max_frequency = 22000;
    c.rebuilt_curves = 1;
    c.use_cache = 1;
    c.tolerance_count = 8;
    c.max_nodes = 200000;
    return c;
}

dSoftModesID dSoftModesCompute(dSoftMeshID id, const dSoftSolid* solids, int solid_count,
                               const int* clamped, int clamped_count,
                               const dSoftModesOptions* options) {
    require_id(solids, __func__);
    const dxSoftMesh* mesh = live(id, __func__);
    if (!mesh)
        return nullptr;
    return guarded(__func__, dSoftModesID{}, [&]() -> dSoftModesID {
        dSoftModesOptions c = dSoftModesOptionsDefault();
        if (options)
            copy_in(*options, "dSoftModesOptionsDefault", &c);
        ModalOptions modal = modal_options(c);
        if (clamped)
            modal.clamped.assign(clamped, clamped + positive(clamped_count, "clamped_count"));
        modal.clamp = clamped != nullptr;
        const ToleranceOptions tolerance = tolerance_options(c);
        std::vector<Solid> all = from_c(solids, solid_count, mesh->mesh);
        all.resize(std::max<std::size_t>(1, mesh->mesh.group_name.size()), all[0]);
        try {
            auto modes = std::make_unique<dxSoftModes>();
            modes->result = modes_to_tolerance(mesh->mesh, all, modal, tolerance);
            modes->t60 = modal_decays(mesh->mesh, all, modes->result.model);
            for (double& t : modes->t60)
                t = t60_of_decay(t);
            modes->nodes = static_cast<int>(mesh->mesh.node.size());
            modes->elements = static_cast<int>(mesh->mesh.element_count());
            return static_cast<dSoftModesID>(modes.release()->id.value());
        } catch (const Cancelled&) {
            throw InputError("cancelled by the progress callback");
        }
    });
}

const char* dSoftGetCacheDirectory(void) {
    return guarded(__func__, static_cast<const char*>(nullptr), []() -> const char* {
        thread_local std::string directory;
        directory = cache_directory().string();
        return directory.empty() ? nullptr : directory.c_str();
    });
}

void dSoftModesDestroy(dSoftModesID id) { delete LiveId<dxSoftModes>::find(id); }

int dSoftModesGetCount(dSoftModesID id) {
    const dxSoftModes* modes = live(id, __func__);
    if (!modes)
        return 0;
    return static_cast<int>(modes->result.model.mode_count());
}

int dSoftModesGetFrequencies(dSoftModesID id, const dReal** first) {
    const dxSoftModes* modes = live(id, __func__);
    if (!modes)
        return 0;
    return give(modes->result.model.frequency, first);
}

int dSoftModesGetErrorCents(dSoftModesID id, const dReal** first) {
    const dxSoftModes* modes = live(id, __func__);
    if (!modes)
        return 0;
    return give(modes->result.model.error_cents, first);
}

int dSoftModesGetT60(dSoftModesID id, const dReal** first) {
    const dxSoftModes* modes = live(id, __func__);
    return modes ? give(modes->t60, first) : 0;
}

int dSoftModesGetShape(dSoftModesID id, int mode, const dReal** first, int* stride) {
    const dxSoftModes* modes = live(id, __func__);
    if (!modes)
        return 0;
    if (mode < 0 || mode >= dSoftModesGetCount(id)) {
        report(format("%s: there is no mode %d of %d", __func__, mode, dSoftModesGetCount(id)));
        return 0;
    }
    *first = modes->result.model.shape_of(static_cast<std::size_t>(mode)).data();
    *stride = 3;
    return modes->nodes;
}

int dSoftModesGetInfo(dSoftModesID id, dSoftModesInfo* out) {
    const dxSoftModes* modes = live(id, __func__);
    if (!modes)
        return 0;
    require_id(out, __func__);
    const TolerantModes& r = modes->result;
    dSoftModesInfo all{};
    all.nodes = modes->nodes;
    all.elements = modes->elements;
    all.solved_nodes = static_cast<int>(r.nodes);
    all.refinements = r.refinements;
    all.rigid_modes = r.model.rigid_modes;
    all.complete = r.model.complete;
    all.mass = r.model.body.mass;
    all.volume = r.model.body.volume;
    for (int i = 0; i < 3; ++i) {
        all.center[i] = r.model.body.centre[i];
        for (int j = 0; j < 3; ++j)
            all.inertia[i][j] = r.model.body.inertia(i, j);
    }
    all.curved_edges = static_cast<int>(r.curve.moved);
    all.limited_edges = static_cast<int>(r.curve.limited);
    all.doubtful_edges = static_cast<int>(r.curve.doubtful);
    return copy_out("dSoftModesGetInfo", all, out);
}
