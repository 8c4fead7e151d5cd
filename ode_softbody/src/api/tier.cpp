#include <ode_softbody/tier.h>

#include "api/boundary.h"
#include "api/editing.h"
#include "api/handles.h"
#include "api/versioned.h"

#include <algorithm>
#include <iterator>

using namespace ode::soft;

int dSoftBodySetTier(dSoftBodyID id, const char* name) {
    require_id(name, __func__);
    Body* body = live(id, __func__);
    if (!body || !may_edit(body->world(), __func__))
        return 0;
    return guarded(__func__, 0, [&] {
        const auto found = std::find_if(std::begin(kTierNames), std::end(kTierNames),
                                        [&](const TierName& t) { return t.name == name; });
        if (found == std::end(kTierNames))
            throw InputError(
                format("there is no tier \"%s\"; known are explicit, modal, cubic, auto", name));
        body->set_tier(found->choice);
        return 1;
    });
}

const char* dSoftBodyGetTier(dSoftBodyID id) {
    const Body* body = live(id, __func__);
    if (!body)
        return nullptr;
    return std::find_if(std::begin(kTierNames), std::end(kTierNames),
                        [&](const TierName& t) { return t.choice == body->tier_choice(); })
        ->name.data();
}

int dSoftBodySetWaveformTolerance(dSoftBodyID id, dReal relative) {
    Body* body = live(id, __func__);
    if (!body || !may_edit(body->world(), __func__))
        return 0;
    return guarded(__func__, 0, [&] {
        if (!(relative > 0 && relative <= 1))
            throw InputError(format("a waveform tolerance of %g is none; give a share of the "
                                    "waveform above 0 and up to 1, such as 0.025",
                                    relative));
        body->set_waveform_tolerance(relative);
        return 1;
    });
}

dReal dSoftBodyGetWaveformTolerance(dSoftBodyID id) {
    const Body* body = live(id, __func__);
    return body ? body->waveform_tolerance() : 0;
}

int dSoftBodyGetModalBasis(dSoftBodyID id, dSoftModalBasis* basis) {
    Body* body = live(id, __func__);
    if (!body || !body->rings())
        return 0;
    const ModalBasis& own = body->modal_motion()->basis();
    static_assert(sizeof(Vec3) == 3 * sizeof(dReal));
    dSoftModalBasis all{};
    all.mode_count = static_cast<int>(own.audible);
    all.node_count = static_cast<int>(own.nodes());
    all.identity = &own;
    all.omega = own.omega.data();
    all.decay = own.decay.data();
    all.rest = own.rest.front().data();
    all.shape = own.shape.data();
    all.stride = static_cast<int>(own.columns);
    if (const CubicTerms* terms = body->modal_motion()->cubic_terms()) {
        const CubicTerms::Sounding& sounding = terms->sounding();
        all.mode_count = all.stride = static_cast<int>(sounding.order.size());
        all.identity = terms;
        all.omega = sounding.omega.data();
        all.decay = sounding.decay.data();
        all.shape = sounding.shape.data();
    }
    return copy_out(__func__, all, basis);
}

int dSoftBodyGetTierStatus(dSoftBodyID id, dSoftTierStatus* status) {
    Body* body = live(id, __func__);
    if (!body)
        return 0;
    dSoftTierStatus all{};
    all.tier = !body->moves()  ? "asleep"
               : body->bends() ? "cubic"
               : body->rings() ? "modal"
                               : "explicit";
    all.modes = body->rings() ? static_cast<int>(body->modal_motion()->basis().modes) : 0;
    all.waveform_error = body->linear_error();
    all.changes = static_cast<int>(body->tier_changes());
    all.cubic_error = body->cubic_error();
    all.kept = body->bends() ? static_cast<int>(body->modal_motion()->cubic()->terms().kept()) : 0;
    all.cost = body->cost();
    return copy_out(__func__, all, status);
}
