#pragma once

#include "base/types.h"
#include "mesh/tet_mesh.h"
#include "model/solid.h"
#include "world/body.h"
#include "world/observer.h"
#include "world/rigid_exchange.h"

#include <memory>
#include <span>
#include <vector>

namespace ode::soft {

/// Work done and work skipped since creation.
struct WorldStats {
    unsigned long steps = 0;
    unsigned long substeps = 0;
    unsigned long element_steps = 0;
    unsigned long contact_points = 0;
    unsigned long contact_tests = 0;
    unsigned long observer_calls = 0;
    double seconds = 0;          ///< time in substeps, observers included [s]
    double observer_seconds = 0; ///< time in observers [s]
};

/// ODE's real step: dWorldStep or dWorldQuickStep.
using RealStep = int (*)(dWorldID, dReal);

/// Soft bodies that live in an ODE world and collide in one of its spaces.
class SoftWorld {
public:
    SoftWorld(dWorldID world, dSpaceID space);
    ~SoftWorld();
    SoftWorld(const SoftWorld&) = delete;
    SoftWorld& operator=(const SoftWorld&) = delete;

    dWorldID ode_world() const noexcept { return world_; }
    dSpaceID space() const noexcept { return space_; }
    double time() const noexcept { return time_; } ///< stepped since creation [s]
    const WorldStats& stats() const noexcept { return stats_; }

    /// @param solids  one a group of the mesh, or one for all of it.
    Body& create_body(const TetMesh& mesh, std::span<const Solid> solids); ///< @throws InputError
    void destroy_body(Body& body) noexcept;
    std::span<const std::unique_ptr<Body>> bodies() const noexcept { return body_; }

    void add_observer(std::unique_ptr<Observer> observer) {
        observer_.push_back(std::move(observer));
    }
    /// Ends the observers that `chosen` accepts. @return how many.
    template <class Predicate>
    std::size_t remove_observers(Predicate chosen) {
        return std::erase_if(observer_, [&](const auto& observer) { return chosen(*observer); });
    }

    /// One step of everything: soft bodies substep by substep against the rigid bodies they touch,
    /// then ODE's own step, then the touched rigid bodies take the state that the substeps gave
    /// them. Re-entered from within (a step inside a callback): passes through to ODE.
    int step(double h, RealStep real_step) noexcept;

    double last_step() const noexcept { return last_step_; } ///< [s]; 0 before the first

private:
    /// Collects pairs for bodies whose space nobody has collided since the last step.
    void meet(double h) noexcept;
    /// The substep that suits all bodies, dividing h [s].
    double common_substep(double h) const noexcept;
    /// Soft bodies, contacts and observers for h seconds. @return false when a body went unstable:
    /// it is then marked stopped and everything is as it was before the call.
    bool advance(double h) noexcept;
    /// From `start` [s]. @return substeps taken: fewer when a body needs shorter ones from now on,
    /// none when one went unstable.
    long run_substeps(double start, double dt, long substeps) noexcept;
    bool all_sound() noexcept;
    void show_substep(double time, double dt) noexcept;
    void watch_step() noexcept;

    dWorldID world_;
    dSpaceID space_;
    double time_ = 0;
    double last_step_ = 0;
    bool stepping_ = false;
    RigidExchange exchange_;
    std::vector<std::unique_ptr<Body>> body_;
    std::vector<std::unique_ptr<Observer>> observer_;
    WorldStats stats_;
};

} // namespace ode::soft
