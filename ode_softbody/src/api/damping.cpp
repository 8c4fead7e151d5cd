#include "model/damping.h"
#include "api/boundary.h"
#include "api/editing.h"
#include "api/handles.h"
#include "api/solid.h"

using namespace ode::soft;

dReal dSoftT60FromDecay(dReal decay) { return t60_of_decay(decay); }
dReal dSoftDecayFromT60(dReal t60) { return decay_of_t60(t60); }
dReal dSoftQFromDecay(dReal decay, dReal frequency) { return quality_of_decay(decay, frequency); }
dReal dSoftDecayFromQ(dReal q, dReal frequency) { return decay_of_quality(q, frequency); }
dReal dSoftLossFactorFromDecay(dReal decay, dReal frequency) {
    return loss_factor_of_decay(decay, frequency);
}
dReal dSoftDecayFromLossFactor(dReal loss_factor, dReal frequency) {
    return decay_of_loss_factor(loss_factor, frequency);
}

dReal dSoftDecayFromSolid(const dSoftSolid* solid, dReal frequency) {
    require_id(solid, __func__);
    return guarded(__func__, dReal{0}, [&] {
        const Solid s = from_c(*solid);
        return RayleighDamping{s.alpha, s.beta}.decay(frequency) +
               decay_of_loss_factor(s.loss_factor, frequency);
    });
}

int dSoftSolidSetT60(dSoftSolid* solid, dReal f1, dReal t1, dReal f2, dReal t2) {
    require_id(solid, __func__);
    return guarded(__func__, 0, [&] {
        const RayleighDamping r = rayleigh_through(f1, t1, f2, t2);
        solid->alpha = r.alpha;
        solid->beta = r.beta;
        return 1;
    });
}

int dSoftBodySetModalDamping(dSoftBodyID id, int on) {
    Body* body = live(id, __func__);
    if (!body || !may_edit(body->world(), __func__))
        return 0;
    return guarded(__func__, 0, [&] {
        BodyForm form = body->form();
        form.modal_damping = on != 0;
        if (!on && (body->has_loss_factor() || !form.damping_table.empty()))
            throw InputError("a loss factor or a damping table needs modes; take it away first");
        body->set_form(form);
        return 1;
    });
}

int dSoftBodyGetModalDamping(dSoftBodyID id) {
    const Body* body = live(id, __func__);
    return body && body->damped_by_modes();
}

int dSoftBodySetDampingTable(dSoftBodyID id, const dReal* frequencies, const dReal* t60,
                             int count) {
    Body* body = live(id, __func__);
    if (!body || !may_edit(body->world(), __func__))
        return 0;
    return guarded(__func__, 0, [&] {
        if (count < 0 || (count > 0 && (!frequencies || !t60)))
            throw InputError(
                format("the table has %d entries, or no array; give count 0 for none", count));
        const auto n = static_cast<std::size_t>(count);
        BodyForm form = body->form();
        form.damping_table = DampingTable({frequencies, n}, {t60, n});
        body->set_form(form);
        return 1;
    });
}
