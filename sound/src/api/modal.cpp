#include "api/guard.h"
#include "api/ids.h"
#include "api/left_open.h"
#include "bridge/rigid_fit.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

using namespace ode::sound;

dSoundModalID dSoundModalCreate(dBodyID body, dSoftMeshID mesh, const dSoftSolid* solid) {
    require_id(body, "dSoundModalCreate");
    require_id(mesh, "dSoundModalCreate");
    require_id(solid, "dSoundModalCreate");
    return guarded("dSoundModalCreate", dSoundModalID{}, [&]() -> dSoundModalID {
        const dSoftWorldID soft = dSoftWorldFind(dBodyGetWorld(body));
        const dSoundWorldID world = soft ? sound_of(soft) : nullptr;
        if (!world) {
            dMessage(0, "dSoundModalCreate: nobody listens to the body's world; call "
                        "dSoftWorldCreate() and dSoundWorldCreate() first");
            return nullptr;
        }
        if (world->world.rigid().has(body)) {
            dMessage(0, "dSoundModalCreate: the body has a voice already; destroy that first");
            return nullptr;
        }
        const std::shared_ptr<const RigidModel> model =
            world->world.rigid_models().find(mesh, *solid);
        if (!model)
            return nullptr;
        if (const std::string why = misfit(body, *model); !why.empty()) {
            dMessage(0, "dSoundModalCreate: %s", why.c_str());
            return nullptr;
        }
        if (const std::string odd = oddity(body, *model); !odd.empty())
            dMessage(0, "dSoundModalCreate: %s", odd.c_str());
        // Now rather than within the first step.
        world->world.rigid_models().voice(model, world->world.scene().settings());
        auto id = std::make_unique<dxSoundModal>();
        world->modals.reserve(world->modals.size() + 1);
        id->owner = world;
        id->rigid = world->world.add_rigid(body, model);
        world->modals.push_back(id.get());
        return id.release();
    });
}

void dSoundModalDestroy(dSoundModalID modal) {
    require_id(modal, "dSoundModalDestroy");
    const dSoundWorldID world = modal->owner;
    std::erase(world->modals, modal);
    if (modal->rigid->body)
        world->world.rigid().remove(*modal->rigid, world->world.scene());
    delete modal;
}

dBodyID dSoundModalGetBody(dSoundModalID modal) {
    require_id(modal, "dSoundModalGetBody");
    return modal->rigid->body;
}

int dSoundModalGetModes(dSoundModalID modal, int count, dReal* frequencies, dReal* t60) {
    require_id(modal, "dSoundModalGetModes");
    const RigidModel& model = *modal->rigid->model;
    for (std::size_t k = 0; k < model.omega.size() && static_cast<int>(k) < count; ++k) {
        if (frequencies)
            frequencies[k] = model.omega[k] / (2.0 * M_PI);
        if (t60)
            t60[k] = dSoftT60FromDecay(model.decay[k]);
    }
    return static_cast<int>(model.omega.size());
}

int dSoundModalSetGain(dSoundModalID modal, dReal gain) {
    require_id(modal, "dSoundModalSetGain");
    return guarded("dSoundModalSetGain", 0, [&] {
        if (!std::isfinite(gain) || gain < 0.0) {
            dMessage(0, "dSoundModalSetGain: gain is %g; it must be 0 (mute) or more", gain);
            return 0;
        }
        modal->owner->world.scene().set_gain(modal->rigid.get(), gain);
        return 1;
    });
}

int dSoundModalStrike(dSoundModalID modal, const dVector3 point, const dVector3 impulse,
                      dReal contact) {
    require_id(modal, "dSoundModalStrike");
    return guarded("dSoundModalStrike", 0, [&] {
        const Vec3 at(point), push(impulse);
        if (!at.allFinite() || !push.allFinite() || !std::isfinite(contact) || !(contact > 0.0)) {
            dMessage(0,
                     "dSoundModalStrike: a stroke of %g N s for %g s at (%g, %g, %g) is none; give "
                     "finite numbers and a contact time above 0",
                     push.norm(), contact, at[0], at[1], at[2]);
            return 0;
        }
        modal->owner->world.strike(*modal->rigid, at, push, contact);
        return 1;
    });
}

int dSoundModalGetVibration(dSoundModalID modal, const dVector3 point, dVector3 velocity) {
    require_id(modal, "dSoundModalGetVibration");
    const RigidBody& rigid = *modal->rigid;
    Vec3 out = Vec3::Zero();
    const StruckVoice* voice = modal->owner->world.scene().find_struck(&rigid);
    if (rigid.body && voice) {
        const RigidMotion motion(rigid.body);
        const Vec3 at = motion.place_in_frame(Vec3(point));
        const StruckSurface& surface = rigid.model->surface;
        out = motion.turn * surface.motion(surface.nearest(at, at), voice->rates());
    }
    for (int k = 0; k < 3; ++k)
        velocity[k] = out[k];
    return rigid.body != nullptr;
}

int dSoundModalGetStatus(dSoundModalID modal, dSoundModalStatus* status) {
    require_id(modal, "dSoundModalGetStatus");
    if (!status || status->struct_size < sizeof(unsigned)) {
        dMessage(0, "dSoundModalGetStatus: set struct_size to sizeof(dSoundModalStatus) before the "
                    "call");
        return 0;
    }
    const RigidBody& rigid = *modal->rigid;
    dSoundModalStatus all{};
    all.struct_size = status->struct_size;
    all.modes = static_cast<int>(rigid.model->omega.size());
    all.blows = rigid.blows;
    if (const StruckVoice* voice = modal->owner->world.scene().find_struck(&rigid))
        all.energy = voice->energy();
    all.mass = rigid.model->mass;
    std::memcpy(status, &all, std::min<std::size_t>(status->struct_size, sizeof all));
    return 1;
}

int dSoundSetGeomSolid(dSoundWorldID world, dGeomID geom, const dSoftSolid* solid) {
    require_id(world, "dSoundSetGeomSolid");
    require_id(solid, "dSoundSetGeomSolid");
    return guarded("dSoundSetGeomSolid", 0, [&] {
        if (!(solid->young > 0.0) || !(solid->poisson > -1.0 && solid->poisson < 0.5)) {
            dMessage(0,
                     "dSoundSetGeomSolid: E is %g Pa and nu %g; give E above 0 and nu between -1 "
                     "and 0.5",
                     solid->young, solid->poisson);
            return 0;
        }
        world->world.rigid().geoms().set_elastic(geom, {solid->young, solid->poisson});
        return 1;
    });
}
