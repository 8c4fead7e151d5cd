#include "api/boundary.h"
#include "api/editing.h"
#include "api/handles.h"
#include "api/solid.h"

#include <vector>

using namespace ode::soft;

namespace {

int set_form(Body& body, const char* function, BodyForm form) noexcept {
    return guarded(function, 0, [&] {
        body.set_form(form);
        return 1;
    });
}

} // namespace

dSoftBodyID dSoftBodyCreateGroups(dSoftWorldID world, dSoftMeshID mesh, const dSoftSolid* solids,
                                  int count) {
    require_id(solids, __func__);
    SoftWorld* home = live(world, __func__);
    const dxSoftMesh* shape = live(mesh, __func__);
    if (!home || !shape || !may_edit(*home, __func__))
        return nullptr;
    return guarded(__func__, dSoftBodyID{}, [&] {
        return to_id(home->create_body(shape->mesh, from_c(solids, count, shape->mesh)));
    });
}

int dSoftBodySetOrder(dSoftBodyID id, int order) {
    Body* body = live(id, __func__);
    if (!body || !may_edit(body->world(), __func__))
        return 0;
    BodyForm form = body->form();
    form.order = order;
    return set_form(*body, __func__, std::move(form));
}

int dSoftBodyGetOrder(dSoftBodyID id) {
    const Body* body = live(id, __func__);
    return body ? body->form().order : 0;
}

int dSoftBodySetMaterialModel(dSoftBodyID id, const char* name) {
    require_id(name, __func__);
    Body* body = live(id, __func__);
    if (!body || !may_edit(body->world(), __func__))
        return 0;
    BodyForm form = body->form();
    form.model = name;
    return set_form(*body, __func__, std::move(form));
}

const char* dSoftBodyGetMaterialModel(dSoftBodyID id) {
    const Body* body = live(id, __func__);
    return body ? body->form().model.c_str() : nullptr;
}

int dSoftBodySetIntegrator(dSoftBodyID id, const char* name) {
    require_id(name, __func__);
    Body* body = live(id, __func__);
    if (!body || !may_edit(body->world(), __func__))
        return 0;
    BodyForm form = body->form();
    form.integrator = name;
    if (!set_form(*body, __func__, std::move(form)))
        return 0;
    if (body->critical_step() == 0)
        report(format("dSoftBodySetIntegrator: %s lets undamped vibrations grow at any substep; it "
                      "is here to be compared with, and the body will be stopped when it has "
                      "blown up",
                      body->form().integrator.c_str()));
    return 1;
}

const char* dSoftBodyGetIntegrator(dSoftBodyID id) {
    const Body* body = live(id, __func__);
    return body ? body->form().integrator.c_str() : nullptr;
}

int dSoftBodySetCurved(dSoftBodyID id, int curved, int* moved) {
    Body* body = live(id, __func__);
    if (!body || !may_edit(body->world(), __func__))
        return 0;
    return guarded(__func__, 0, [&] {
        BodyForm form = body->form();
        form.curved = curved != 0;
        const CurveReport result = body->set_form(form);
        if (moved)
            *moved = static_cast<int>(result.moved);
        if (result.doubtful > 0)
            report(format("dSoftBodySetCurved: %zu of %zu surface edges may be sharp or round; "
                          "give at least ten facets round a circle to make it certain",
                          result.doubtful, result.surface_edges));
        return 1;
    });
}
