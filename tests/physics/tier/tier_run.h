#pragma once

#include "mesh/generate.h"
#include "model/materials.h"
#include "world/soft_world.h"

#include <ode/ode.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <memory>
#include <vector>

namespace ode::soft {

inline double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A steel bowl in a world of its own.
class TierRun {
public:
    explicit TierRun(TierChoice tier, int order = 1, double gravity = 0)
        : TierRun(make_bowl(0.1, 0.005, 1.4, 8, 48, 1), tier, order, gravity) {}
    TierRun(const TetMesh& mesh, TierChoice tier, int order, double gravity)
        : ode_((dInitODE2(0), dWorldCreate())), space_(dHashSpaceCreate(nullptr)),
          world_(std::make_unique<SoftWorld>(ode_, space_)) {
        dWorldSetGravity(ode_, 0, 0, gravity);
        Solid solid = find_material("steel")->solid;
        solid.alpha = 0;
        solid.phi = solid.psi = 0;
        solid.beta = 1.7e-7;
        solid.loss_factor = 0;
        body_ = &world_->create_body(mesh, {&solid, 1});
        if (order != 1) {
            BodyForm form = body_->form();
            form.order = order;
            body_->set_form(form);
        }
        body_->set_tier(tier);
    }
    ~TierRun() {
        world_.reset();
        dSpaceDestroy(space_);
        dWorldDestroy(ode_);
    }

    Body& body() { return *body_; }
    SoftWorld& world() { return *world_; }
    dSpaceID space() { return space_; }
    dWorldID ode() { return ode_; }

    void step(double h) {
        const double before = cpu_seconds();
        dSpaceCollide(space_, nullptr, [](void*, dGeomID, dGeomID) {});
        world_->step(h, dWorldStep);
        seconds_ += cpu_seconds() - before;
    }
    double seconds() const { return seconds_; }

private:
    dWorldID ode_;
    dSpaceID space_;
    std::unique_ptr<SoftWorld> world_;
    Body* body_ = nullptr;
    double seconds_ = 0;
};

/// Relative L2 difference of two signals.
inline double relative_error(const std::vector<double>& a, const std::vector<double>& reference) {
    double off = 0, all = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        off += (a[i] - reference[i]) * (a[i] - reference[i]);
        all += reference[i] * reference[i];
    }
    return std::sqrt(off / all);
}

/// Tilts the body and throws it down from so far over a floor [m], [m/s].
inline void throw_down(TierRun& run, double height, double speed) {
    Body& body = run.body();
    dCreatePlane(run.space(), 0, 0, 1, 0);
    body.rotate(Quat(Eigen::AngleAxisd(0.4, Vec3(1, 0.3, 0).normalized())));
    double low = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < body.mass().size(); ++i)
        low = std::min(low, body.state().position[i].z());
    body.move_to(body.center_of_mass() + Vec3(0, 0, height - low));
    body.set_velocity({0, 0, -speed});
}

/// What is heard of a body's motion, however it moves: amplitudes of its modes times their angular
/// frequency [kg^1/2 m/s]. Of amplitudes, not of their rates: the explicit velocity lags by half a
/// substep.
inline AlignedVector<double> audible(const Body& body,
                                     const std::shared_ptr<const ModalBasis>& basis) {
    ModalMotion seen(basis);
    seen.take(body.state(), {});
    AlignedVector<double> swing = seen.state().amplitude;
    swing.resize(basis->audible);
    for (std::size_t k = 0; k < swing.size(); ++k)
        swing[k] *= basis->omega[k];
    return swing;
}

/// Relative L2 difference of it, step by step.
inline double audible_error(const std::vector<AlignedVector<double>>& of,
                            const std::vector<AlignedVector<double>>& reference) {
    double off = 0, all = 0;
    for (std::size_t t = 0; t < reference.size(); ++t)
        for (std::size_t k = 0; k < reference[t].size(); ++k) {
            off += (of[t][k] - reference[t][k]) * (of[t][k] - reference[t][k]);
            all += reference[t][k] * reference[t][k];
        }
    return std::sqrt(off / all);
}

} // namespace ode::soft
