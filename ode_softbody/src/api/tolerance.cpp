#include "world/choose_form.h"

#include "api/boundary.h"
#include "api/editing.h"
#include "api/handles.h"
#include "api/versioned.h"

#include <cmath>

using namespace ode::soft;

int dSoftBodySetTolerance(dSoftBodyID id, dReal cents, dSoftChoice* choice) {
    Body* body = live(id, __func__);
    if (!body || !may_edit(body->world(), __func__))
        return 0;
    return guarded(__func__, 0, [&] {
        if (!(cents > 0 && std::isfinite(cents)))
            throw InputError(format("the tolerance is %g cents; give one above 0", cents));
        const FormChoice best = choose_form(*body, cents);
        if (choice) {
            const dSoftChoice out = {sizeof out,
                                     best.form.order,
                                     body->form().model.c_str(),
                                     body->form().integrator.c_str(),
                                     best.substep,
                                     best.expected_cents};
            if (!copy_out("dSoftBodySetTolerance", out, choice))
                return 0;
        }
        if (best.expected_cents > cents) {
            report(format("dSoftBodySetTolerance: the truest form of this body (order %d, %s) is "
                          "expected to be off by %.3g cents, %.3g asked for; it has that form now. "
                          "Bring a finer mesh: `softsound modes --tolerance` tells how fine",
                          best.form.order, best.form.integrator.c_str(), best.expected_cents,
                          cents));
            return 0;
        }
        return 1;
    });
}
