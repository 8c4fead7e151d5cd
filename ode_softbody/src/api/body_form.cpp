#include "api/boundary.h"
#include "api/handles.h"
#include "api/solid.h"

#include <algorithm>
#include <vector>

using namespace ode::soft;

namespace {

int set_form(dSoftBodyID id, const char* function, BodyForm form) noexcept {
    return guarded(function, 0, [&] {
        from_id(id).set_form(form);
        return 1;
    });
}

} // namespace

dSoftBodyID dSoftBodyCreateGroups(dSoftWorldID world, dSoftMeshID mesh, const dSoftSolid* solids,
                                  int count) {
    require_id(world, __func__);
    require_id(mesh, __func__);
    require_id(solids, __func__);
    return guarded(__func__, dSoftBodyID{}, [&] {
        const std::size_t groups = std::max<std::size_t>(1, mesh->mesh.group_name.size());
        if (count != 1 && (count < 1 || static_cast<std::size_t>(count) != groups))
            throw InputError(format("%d solids for a mesh of %zu groups; give one a group, or one "
                                    "for all",
                                    count, groups));
        std::vector<Solid> all;
        // The application's struct may be shorter than ours.
        const auto* at = reinterpret_cast<const char*>(solids);
        for (int i = 0; i < count; ++i, at += solids->struct_size)
            all.push_back(from_c(*reinterpret_cast<const dSoftSolid*>(at)));
        return to_id(from_id(world).create_body(mesh->mesh, all));
    });
}

int dSoftBodySetOrder(dSoftBodyID id, int order) {
    require_id(id, __func__);
    BodyForm form = from_id(id).form();
    form.order = order;
    return set_form(id, __func__, std::move(form));
}

int dSoftBodyGetOrder(dSoftBodyID id) {
    require_id(id, __func__);
    return from_id(id).form().order;
}

int dSoftBodySetMaterialModel(dSoftBodyID id, const char* name) {
    require_id(id, __func__);
    require_id(name, __func__);
    BodyForm form = from_id(id).form();
    form.model = name;
    return set_form(id, __func__, std::move(form));
}

const char* dSoftBodyGetMaterialModel(dSoftBodyID id) {
    require_id(id, __func__);
    return from_id(id).form().model.c_str();
}

int dSoftBodySetIntegrator(dSoftBodyID id, const char* name) {
    require_id(id, __func__);
    require_id(name, __func__);
    BodyForm form = from_id(id).form();
    form.integrator = name;
    if (!set_form(id, __func__, std::move(form)))
        return 0;
    if (from_id(id).critical_step() == 0)
        report(format("dSoftBodySetIntegrator: %s lets undamped vibrations grow at any substep; it "
                      "is here to be compared with, and the body will be stopped when it has "
                      "blown up",
                      dSoftBodyGetIntegrator(id)));
    return 1;
}

const char* dSoftBodyGetIntegrator(dSoftBodyID id) {
    require_id(id, __func__);
    return from_id(id).form().integrator.c_str();
}

int dSoftBodySetCurved(dSoftBodyID id, int curved, int* moved) {
    require_id(id, __func__);
    return guarded(__func__, 0, [&] {
        BodyForm form = from_id(id).form();
        form.curved = curved != 0;
        const CurveReport result = from_id(id).set_form(form);
        if (moved)
            *moved = static_cast<int>(result.moved);
        if (result.doubtful > 0)
            report(format("dSoftBodySetCurved: %zu of %zu surface edges may be sharp or round; "
                          "give at least ten facets round a circle to make it certain",
                          result.doubtful, result.surface_edges));
        return 1;
    });
}
