#include "api/boundary.h"
#include "api/editing.h"
#include "api/handles.h"
#include "api/versioned.h"

using namespace ode::soft;

int dSoftBodyEnable(dSoftBodyID id) {
    Body* body = live(id, __func__);
    if (!body || !may_edit(body->world(), __func__))
        return 0;
    body->wake();
    return 1;
}

int dSoftBodyDisable(dSoftBodyID id) {
    Body* body = live(id, __func__);
    if (!body || !may_edit(body->world(), __func__))
        return 0;
    if (body->is_nailed()) {
        report(format("%s: the body is nailed to a rigid one, which it must follow; call "
                      "dSoftBodyDetachNodes() before",
                      __func__));
        return 0;
    }
    body->fall_asleep();
    return 1;
}

int dSoftBodyIsEnabled(dSoftBodyID id) {
    const Body* body = live(id, __func__);
    return body && body->moves();
}

int dSoftBodySetAutoDisableFlag(dSoftBodyID id, int on) {
    Body* body = live(id, __func__);
    if (!body)
        return 0;
    body->set_auto_disable(on != 0);
    return 1;
}

int dSoftBodyGetAutoDisableFlag(dSoftBodyID id) {
    const Body* body = live(id, __func__);
    return body && body->auto_disable();
}

dSoftRest dSoftRestDefault(void) {
    const RestLimits limits;
    dSoftRest rest{};
    rest.struct_size = sizeof rest;
    rest.speed = limits.speed;
    rest.acceleration = limits.acceleration;
    rest.time = limits.time;
    return rest;
}

int dSoftBodySetRest(dSoftBodyID id, const dSoftRest* rest) {
    require_id(rest, __func__);
    Body* body = live(id, __func__);
    if (!body)
        return 0;
    return guarded(__func__, 0, [&] {
        dSoftRest r = dSoftRestDefault();
        copy_in(*rest, "dSoftRestDefault", &r);
        if (!(r.speed >= 0 && r.acceleration >= 0 && r.time >= 0))
            throw InputError(format("speed %g m/s, acceleration %g m/s^2 or time %g s is negative "
                                    "or not a number; give values of at least 0",
                                    r.speed, r.acceleration, r.time));
        body->set_rest_limits({r.speed, r.acceleration, r.time});
        return 1;
    });
}
