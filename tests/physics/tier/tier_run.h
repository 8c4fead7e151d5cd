#pragma once

#include "mesh/generate.h"
#include "model/materials.h"
#include "world/soft_world.h"

#include <ode/ode.h>

#include <cmath>
#include <ctime>
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

} // namespace ode::soft
