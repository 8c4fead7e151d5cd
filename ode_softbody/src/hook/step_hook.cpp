#include "hook/step_hook.h"

#include "base/error.h"
#include "hook/interposed.h"
#include "hook/ode_layout.h"
#include "hook/threading_shim.h"
#include "hook/world_watch.h"
#include "world/registry.h"
#include "world/soft_world.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace ode::soft {
namespace {

constexpr const char* kCure =
    "link ode_softbody before ode, start the program with LD_PRELOAD=libode_softbody.so, or step "
    "through dSoftWorldStep()";

/// Steps a soft world whose ODE world is stepped behind our back.
class ThreadingHook final : public StepListener {
public:
    explicit ThreadingHook(SoftWorld& soft)
        : soft_(&soft), world_(soft.ode_world()), layout_(ode_layout()), watch_(world_) {
        if (!layout_)
            return;
        // The application's thread pool goes on working, behind ours.
        functions_ = value_at<const dThreadingFunctionsInfo*>(world_, layout_->functions);
        behind_ = value_at<dThreadingImplementationID>(world_, layout_->implementation);
        if (behind_)
            shim_.emplace(*this, functions_, behind_);
        else
            shim_.emplace(*this);
        if (shim_->usable())
            shim_->give_to(world_);
    }
    ~ThreadingHook() {
        if (installed())
            dWorldSetStepThreadingImplementation(world_, behind_ ? functions_ : nullptr, behind_);
    }

    /// Whether the world still has it: the application may have given it another implementation.
    bool installed() noexcept {
        return shim_ && !watch_.gone() &&
               value_at<dThreadingImplementationID>(world_, layout_->implementation) == shim_->id();
    }
    bool orphaned() const noexcept { return watch_.gone(); }
    bool serves(const SoftWorld& soft) const noexcept { return soft_ == &soft; }
    bool idle() const noexcept { return !soft_; }
    void let_go() noexcept { soft_ = nullptr; }

    void on_step_posted(const void* context) noexcept override {
        stepping_ = soft_ && soft_->begin_step(value_at<double>(context, layout_->step_length));
    }
    void on_step_done() noexcept override {
        if (stepping_)
            soft_->end_step();
        stepping_ = false;
    }
    void on_released() noexcept override {
        if (!soft_)
            return;
        if (watch_.gone())
            forget_world(world_);
        else
            report(format("the world's threading implementation was changed, so that its steps "
                          "move no soft bodies any more; %s",
                          kCure));
    }

private:
    SoftWorld* soft_;
    dWorldID world_;
    std::optional<OdeLayout> layout_;
    WorldWatch watch_;
    const dThreadingFunctionsInfo* functions_ = nullptr; ///< the world had before, with behind_
    dThreadingImplementationID behind_ = nullptr;        ///< nullptr: ODE's default
    std::optional<ThreadingShim> shim_;
    bool stepping_ = false;
};

std::mutex lock;
/// Never destroyed: at the program's end ODE may be inside one, or closed.
std::vector<std::unique_ptr<ThreadingHook>>& hooks() {
    static auto& all = *new std::vector<std::unique_ptr<ThreadingHook>>;
    return all;
}

ThreadingHook* hook_for(const SoftWorld& world) {
    const std::lock_guard guard(lock);
    const auto found = std::find_if(hooks().begin(), hooks().end(),
                                    [&](const auto& h) { return h->serves(world); });
    return found == hooks().end() ? nullptr : found->get();
}

/// Lets the hook know that the soft world ends. The hook itself goes later: ODE may be inside it.
class Farewell final : public Observer {
public:
    explicit Farewell(ThreadingHook& hook) noexcept : hook_(hook) {}
    bool wants_substeps() const noexcept override { return false; }
    void on_substep(const SubstepView&) noexcept override {}
    void on_step(SoftWorld&, double) noexcept override {}
    void on_body_end(Body&) noexcept override {}
    void on_world_end(SoftWorld&) noexcept override { hook_.let_go(); }

private:
    ThreadingHook& hook_;
};

} // namespace

void attach_hook(SoftWorld& world) {
    if (steps_are_interposed(world.ode_world()))
        return;
    auto made = std::make_unique<ThreadingHook>(world);
    world.add_observer(std::make_unique<Farewell>(*made));
    static bool said = false;
    if (!made->installed() && !std::exchange(said, true))
        report(format("dSoftWorldCreate: nothing tells this library of the world's steps, so that "
                      "soft bodies would stand still; %s",
                      kCure));
    const std::lock_guard guard(lock);
    std::erase_if(hooks(), [](const auto& hook) { return hook->idle(); });
    hooks().push_back(std::move(made));
}

Hook hook_of(const SoftWorld& world) {
    if (ThreadingHook* hook = hook_for(world))
        return hook->installed() ? Hook::threading : Hook::none;
    return Hook::interposed;
}

bool end_if_orphaned(SoftWorld& world) {
    const ThreadingHook* hook = hook_for(world);
    if (!hook || !hook->orphaned())
        return false;
    destroy_world(world);
    return true;
}

} // namespace ode::soft
