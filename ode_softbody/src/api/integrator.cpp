#include "integrate/modal_response.h"

#include "api/boundary.h"
#include "api/versioned.h"

#include <ode_softbody/softbody.h>

#include <cmath>

using namespace ode::soft;

const char* dSoftIntegratorName(int i) {
    const auto kinds = integrator_kinds();
    return i >= 0 && static_cast<std::size_t>(i) < kinds.size()
               ? kinds[static_cast<std::size_t>(i)].name.data()
               : nullptr;
}

int dSoftIntegratorGetInfo(const char* name, dSoftIntegratorInfo* info) {
    require_id(name, __func__);
    require_id(info, __func__);
    return guarded(__func__, 0, [&] {
        const IntegratorKind& kind = integrator_kind(name);
        const dSoftIntegratorInfo out = {sizeof out, kind.order, kind.implicit, kind.forces};
        return copy_out("dSoftIntegratorGetInfo", out, info);
    });
}

int dSoftIntegratorGetResponse(const char* name, dReal omega_h, dReal damping_ratio,
                               dSoftIntegratorResponse* response) {
    require_id(name, __func__);
    require_id(response, __func__);
    return guarded(__func__, 0, [&] {
        if (!(omega_h > 0 && std::isfinite(omega_h)))
            throw InputError(format("omega h is %g; give one above 0", omega_h));
        if (!(damping_ratio >= 0 && std::isfinite(damping_ratio)))
            throw InputError(format("the damping ratio is %g; give 0 or more", damping_ratio));
        const ModalResponse r = ModalAnalysis(name).response(omega_h, damping_ratio);
        const dSoftIntegratorResponse out = {sizeof out, r.amplification, r.artificial_damping,
                                             r.period_error};
        return copy_out("dSoftIntegratorGetResponse", out, response);
    });
}
