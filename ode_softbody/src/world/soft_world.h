#pragma once

#include "base/live_id.h"
#include "base/tasks.h"
#include "base/types.h"
#include "mesh/tet_mesh.h"
#include "model/solid.h"
#include "world/attachments.h"
#include "world/body.h"
#include "world/cabinet.h"
#include "world/observer.h"
#include "world/other_spaces.h"
#include "world/rigid_exchange.h"
#include "world/rigid_pairs.h"
#include "world/slumber.h"
#include "world/soft_exchange.h"

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
    unsigned long soft_pairs = 0;
    unsigned long soft_looks = 0;
    unsigned long soft_tests = 0;
    unsigned long body_substeps = 0;
    unsigned long modal_substeps = 0; ///< of them, in modes
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
    dSpaceID space() const noexcept { return space_; } ///< nullptr once it is destroyed
    void lose_space() noexcept { space_ = nullptr; }
    double time() const noexcept { return time_; } ///< stepped since creation [s]
    const WorldStats& stats() const noexcept { return stats_; }

    /// @param solids  one a group of the mesh, or one for all of it.
    Body& create_body(const TetMesh& mesh, std::span<const Solid> solids); ///< @throws InputError
    void destroy_body(Body& body) noexcept;
    std::span<const std::unique_ptr<Body>> bodies() const noexcept { return body_; }

    void add_observer(std::unique_ptr<Observer> observer) {
        observer_.push_back(std::move(observer));
    }
    /// No observer that `chosen` accepts is called any more. @return how many.
    template <class Predicate>
    std::size_t remove_observers(Predicate chosen) {
        std::size_t removed = 0;
        for (auto& observer : observer_)
            if (observer && chosen(*observer)) {
                past_observer_.push_back(std::move(observer));
                ++removed;
            }
        drop_past_observers();
        return removed;
    }

    /// One step of everything: soft bodies substep by substep against the rigid bodies they touch,
    /// then ODE's own step, then the touched rigid bodies take the state that the substeps gave
    /// them. Re-entered from within (a step inside a callback): passes through to ODE.
    int step(double h, RealStep real_step) noexcept;

    /// The halves of step(), for who is told of a step while it is under way: before bodies move
    /// and after. @return false: refused, or within a step already; then leave out end_step().
    bool begin_step(double h) noexcept;
    void end_step() noexcept;
    bool stepping() const noexcept { return stepping_; }
    /// Observers may be on the stack: bodies must stay.
    bool busy() const noexcept { return stepping_ || calling_; }
    void* id() const noexcept { return id_.value(); }

    /// Asked for every pair from the next step on; empty: the soft bodies' own laws hold.
    void set_contact_chooser(ContactChooser chooser) { contact_chooser_ = std::move(chooser); }

    SoftContactMethod soft_contact_method() const noexcept { return soft_exchange_.method(); }
    void set_soft_contact_method(SoftContactMethod method) noexcept {
        soft_exchange_.set_method(method);
    }

    /// Who does the pieces of a substep; nullptr, at first: the thread that steps. The motion is
    /// the same, bit for bit.
    const Tasks* tasks() const noexcept { return tasks_.get(); }
    void set_tasks(std::unique_ptr<Tasks> tasks) noexcept { tasks_ = std::move(tasks); }

    Attachments& attachments() noexcept { return attachments_; }

    Cabinet<ModalBasis>& bases() noexcept { return bases_; }
    Cabinet<CubicTerms>& cubics() noexcept { return cubics_; }

    double last_step() const noexcept { return last_step_; } ///< [s]; 0 before the first

    /// The rigid side of the present step.
    const RigidExchange& exchange() const noexcept { return exchange_; }
    /// A contact joint has been made in this world.
    void note_contact(dJointID joint, const dContact& contact) {
        exchange_.note_contact(joint, contact);
    }
    /// What a contact joint was made of; nullptr: nobody saw.
    const dContact* find_contact(dJointID joint) const noexcept {
        return exchange_.find_contact(joint);
    }

private:
    friend class Body;

    bool accepts(double h) const noexcept;
    /// Collects what is near each body, in its own space and in those that the application has
    /// collided it with, and settles which pairs bear contact, and how.
    void meet(double h) noexcept;
    bool many_in_one_space() const noexcept; ///< that all move, and nothing else is in it but geoms
    /// The substep that suits all bodies that move, dividing h [s].
    double common_substep(double h) const noexcept;
    /// The same from `done` on of a step of h, where every body may take what it likes: a power of
    /// two to the step, so that few lengths are met.
    double next_substep(double h, double done) const noexcept;
    /// Finds for how long bodies in modes ring undisturbed, and paces them.
    void look_ahead(bool first) noexcept;
    bool all_ring() const noexcept; ///< of those that move
    /// Soft bodies, contacts and observers for h seconds. @return false when a body went unstable:
    /// its substep is then shortened, or it is stopped, and everything is as it was before the call
    /// but for what observers have seen. The rigid bodies' side is made anew from ODE's bodies,
    /// which nothing has reached yet, so that no impulse is given twice.
    /// @param again  such a step is redone.
    bool advance(double h, bool again) noexcept;
    /// From `start` [s]. @return substeps taken: fewer when a body needs shorter ones from now on,
    /// none when one went unstable.
    long run_substeps(double start, double dt, long substeps) noexcept;
    /// Who moves in the substeps to come, and whether they are to be moved side by side.
    void list_moving() noexcept;
    template <class Visit>
    void each_moving(Visit visit) noexcept {
        if (side_by_side_) {
            in_pieces(moving_.size(), [&](std::size_t i) { visit(*moving_[i]); });
            return;
        }
        for (Body* body : moving_)
            visit(*body);
    }
    /// Looks at the bodies; if one is unstable takes all of them back to the start of the step.
    bool all_sound() noexcept;
    /// Observers may be added and removed by one of them meanwhile.
    template <class Call>
    void each_observer(Call call) {
        const bool outer = calling_;
        calling_ = true;
        for (std::size_t i = 0; i < observer_.size(); ++i)
            if (observer_[i])
                call(*observer_[i]);
        calling_ = outer;
        drop_past_observers();
    }
    void drop_past_observers() noexcept;                ///< unless one may be on the stack
    void show_substep(double time, double dt) noexcept; ///< to who wants such
    void watch_step() noexcept;
    void watch_move() noexcept;

    dWorldID world_;
    dSpaceID space_;
    double time_ = 0;
    double last_step_ = 0;
    double shown_ = 0;           ///< time of the last substep shown to observers [s]
    double not_shown_until_ = 0; ///< while a step is redone: what has been shown already [s]
    bool stepping_ = false;
    bool meeting_ = false; ///< within meet(): pairs are for the step to come
    OtherSpaces other_spaces_;
    ContactChooser contact_chooser_;
    Said said_; ///< of geoms that bear no contact
    RigidExchange exchange_;
    Attachments attachments_;
    SoftExchange soft_exchange_;
    Cabinet<ModalBasis> bases_;
    Cabinet<CubicTerms> cubics_;
    bool any_rings_ = false;     ///< in this step
    bool nodes_watched_ = false; ///< by observers that take no modes
    Slumber slumber_;
    std::vector<std::unique_ptr<Body>> body_;
    std::vector<Body*> moving_; ///< of them, in the present substeps
    bool side_by_side_ = false;
    std::unique_ptr<Tasks> tasks_;
    std::vector<std::unique_ptr<Observer>> observer_;      ///< null: removed while busy
    std::vector<std::unique_ptr<Observer>> past_observer_; ///< removed, maybe still on the stack
    bool calling_ = false;                                 ///< observers
    WorldStats stats_;
    LiveId<SoftWorld> id_{*this};
    unsigned long made_ = 0; ///< bodies so far
};

} // namespace ode::soft
