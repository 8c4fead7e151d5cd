// Preloaded: drops a sounding soft body into the first space that the program collides, with two
// ears beside it. The program knows nothing of it.
//
//   CONFORMANCE_DROP         "pass x y z kind size speed": before this collision pass (1, 2, ...) a
//                            body of a kind below, `size` [m] across, appears at x, y, z [m] and
//                            falls at `speed` [m/s]
//   CONFORMANCE_SOFT_REPORT  file to write

#include "program_watch.h"

#include <ode/ode.h>
#include <ode_sound/sound.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

namespace ode::conformance {
namespace {

struct Kind {
    const char* name;
    const char* material;
    int order;
    dSoftMeshID (*mesh)(dReal size);
};
constexpr std::array kKinds{
    Kind{"block", "rubber", 1, [](dReal s) { return dSoftMeshCreateBox(s, s, s, 2, 2, 2); }},
    Kind{"pudding", "rubber", 2, [](dReal s) { return dSoftMeshCreateBox(s, s, s, 1, 1, 1); }},
    Kind{"ball", "rubber", 1, [](dReal s) { return dSoftMeshCreateSphere(s / 2, 2); }},
    Kind{"bowl", "steel", 1,
         [](dReal s) { return dSoftMeshCreateBowl(s / 2, s / 20, 1.57, 2, 8, 1); }},
};

struct Plan {
    int pass = 0;
    dVector3 at{};
    char kind[16] = "";
    dReal size = 0, speed = 0;
};

double cpu_seconds() {
    timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Ids are void once the program has destroyed its world: nothing is asked of them after that.
class Drop {
public:
    Drop() {
        stats_.struct_size = sizeof stats_;
        status_.struct_size = sizeof status_;
        heard_.struct_size = sizeof heard_;
        const char* text = std::getenv("CONFORMANCE_DROP");
        if (!text ||
            std::sscanf(text, "%d %lf %lf %lf %15s %lf %lf", &plan_.pass, &plan_.at[0],
                        &plan_.at[1], &plan_.at[2], plan_.kind, &plan_.size, &plan_.speed) != 7) {
            std::fprintf(stderr, "CONFORMANCE_DROP: pass x y z kind size speed are wanted\n");
            std::exit(2);
        }
    }

    dWorldID world = nullptr;

    void on_pass(dSpaceID space) {
        if (++pass_ == plan_.pass)
            create(space);
        else if (body_)
            look();
    }
    void on_end() { body_ = nullptr; }
    void write() const;

private:
    void create(dSpaceID space) {
        const auto* kind = std::find_if(kKinds.begin(), kKinds.end(), [&](const Kind& k) {
            return std::strcmp(k.name, plan_.kind) == 0;
        });
        dSoftSolid solid{};
        solid.struct_size = sizeof solid;
        if (kind == kKinds.end() || !dSoftSolidPreset(kind->material, &solid))
            std::exit(2);
        soft_ = dSoftWorldCreate(world, space);
        const dSoftMeshID mesh = kind->mesh(plan_.size);
        body_ = dSoftBodyCreate(soft_, mesh, &solid);
        dSoftMeshDestroy(mesh);
        if (!dSoftBodySetOrder(body_, kind->order))
            std::exit(2);
        dSoftBodySetPosition(body_, plan_.at[0], plan_.at[1], plan_.at[2]);
        dSoftBodySetLinearVel(body_, 0, 0, -plan_.speed);
        dSoftObserver watch{};
        watch.struct_size = sizeof watch;
        watch.data = this;
        watch.on_world_end = [](void* drop, dSoftWorldID) { static_cast<Drop*>(drop)->on_end(); };
        dSoftWorldAddObserver(soft_, &watch);

        sound_ = dSoundWorldCreate(soft_);
        const dSoundListenerID ears = dSoundListenerCreate(sound_);
        dSoundListenerSetPosition(ears, plan_.at[0], plan_.at[1] - 1, plan_.at[2]);
        dSoundListenerSetSink(ears, dSoundSinkCreateMemory());
        momentum(before_);
        start_ = cpu_seconds();
    }

    void momentum(dVector3 linear) const {
        dVector3 angular;
        dSoftBodyGetMomentum(body_, linear, angular);
    }

    /// After a whole step of everything.
    void look() {
        dVector3 now, g;
        momentum(now);
        dWorldGetGravity(world, g);
        const dReal t = dSoftWorldGetTime(soft_);
        dReal square = 0;
        for (int i = 0; i < 3; ++i) {
            const dReal blow = now[i] - before_[i] - dSoftBodyGetMass(body_) * g[i] * (t - time_);
            square += blow * blow;
            before_[i] = now[i];
        }
        time_ = t;
        impulse_ += std::sqrt(square);
        measure(std::sqrt(dCalcVectorLengthSquare3(g)));
    }

    void measure(dReal gravity) {
        dSoftWorldGetStats(soft_, &stats_);
        dSoftBodyGetStatus(body_, &status_);
        dSoundGetStats(sound_, &heard_);
        dSoftBodyGetCenterOfMass(body_, center_);
        mass_ = dSoftBodyGetMass(body_);
        const dSoftEnergy energy = dSoftBodyGetEnergy(body_);
        finite_ = std::isfinite(energy.kinetic + energy.elastic + center_[0] + center_[1] +
                                center_[2] + impulse_);
        cpu_ = cpu_seconds() - start_;
        // Whatever it hits, it must not leave faster than its fall explains.
        lowest_ = std::min(lowest_, center_[2]);
        const dReal fall = plan_.at[2] - lowest_;
        const dReal most =
            std::sqrt(plan_.speed * plan_.speed + 2 * gravity * std::max<dReal>(fall, 0));
        const dReal speed = std::sqrt(dCalcVectorLengthSquare3(before_)) / mass_;
        gain_ = std::max(gain_, speed / most);
        brought_ = mass_ * most * most / 2;
    }

    Plan plan_;
    int pass_ = 0;
    dSoftWorldID soft_ = nullptr;
    dSoftBodyID body_ = nullptr;
    dSoundWorldID sound_ = nullptr;
    dVector3 before_{}; ///< momentum at the last look [kg m/s]
    dReal time_ = 0;    ///< of the last look [s]
    dReal impulse_ = 0; ///< of contacts, sum of the magnitudes over steps [N s]
    double start_ = 0;
    // As last measured.
    dSoftWorldStats stats_{};
    dSoftStatus status_{};
    dSoundStats heard_{};
    dVector3 center_{};
    dReal lowest_ = dInfinity;
    dReal gain_ = 0; ///< largest speed over what the fall so far explains
    dReal mass_ = 0;
    dReal brought_ = 0; ///< kinetic energy that its fall so far explains [J]
    bool finite_ = false;
    double cpu_ = 0;
};

void Drop::write() const {
    const char* path = std::getenv("CONFORMANCE_SOFT_REPORT");
    std::FILE* out = path ? std::fopen(path, "w") : nullptr;
    if (!out)
        return;
    std::fprintf(out,
                 "steps %lu\nsubsteps %lu\ncontacts %lu\nimpulse %g\nmass %g\n"
                 "center %g %g %g\nfinite %d\nstopped %d\npeak %g\ngain %g\nbrought %g\nseconds "
                 "%g\ncpu %g\n",
                 stats_.steps, stats_.substeps, stats_.contact_points, impulse_, mass_, center_[0],
                 center_[1], center_[2], finite_, status_.stopped, heard_.peak, gain_, brought_,
                 time_, cpu_);
    std::fclose(out);
}

Drop& drop() {
    static Drop& only = *new Drop; // programs end worlds at exit, too
    return only;
}

} // namespace

void on_world(dWorldID world) {
    if (!drop().world)
        drop().world = world;
}
void on_collide(dSpaceID space) {
    if (drop().world)
        drop().on_pass(space);
}
void on_closed() { drop().write(); }
void on_world_end(dWorldID) {}
void on_space(dSpaceID) {}
void on_space_end(dSpaceID) {}
void on_body_placed(dWorldID) {}

} // namespace ode::conformance
