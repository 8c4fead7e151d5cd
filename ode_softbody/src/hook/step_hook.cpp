#include "hook/step_hook.h"

#include "base/error.h"
#include "hook/interposed.h"
#include "hook/step_length.h"
#include "hook/threading_shim.h"
#include "hook/world_watch.h"
#include "world/registry.h"
#include "world/soft_world.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <vector>

namespace ode::soft {
namespace {

constexpr const char* kCure =
    "link ode_softbody before ode, start the program with LD_PRELOAD=libode_softbody.so, or step "
    "through dSoftWorldStep()";

/// Steps a soft world whose ODE world is stepped behind our back.
class ThreadingHook final : public StepListener {
public:
    ThreadingHook(SoftWorld& soft, std::size_t offset)
        : soft_(&soft), world_(soft.ode_world()), offset_(offset), watch_(world_), shim_(*this) {}
    ~ThreadingHook() {
        if (!watch_.gone() && installed())
            dWorldSetStepThreadingImplementation(world_, nullptr, nullptr);
    }

    void install() noexcept {
        if (shim_.usable())
            shim_.give_to(world_);
    }
    bool installed() noexcept { return shim_.usable() && shim_.is_of(world_); }
    bool orphaned() const noexcept { return watch_.gone(); }
    bool serves(const SoftWorld& soft) const noexcept { return soft_ == &soft; }
    bool idle() const noexcept { return !soft_; }
    void let_go() noexcept { soft_ = nullptr; }

    void on_step_posted(const void* context) noexcept override {
        stepping_ = soft_ && soft_->begin_step(read_step_length(context, offset_));
    }
    void on_step_done() noexcept override {
        if (stepping_)
            soft_->end_step();
        stepping_ = false;
    }
    void on_released() noexcept override {
        if (soft_ && watch_.gone())
            forget_world(world_);
    }

private:
    SoftWorld* soft_;
    dWorldID world_;
    std::size_t offset_;
    bool stepping_ = false;
    WorldWatch watch_;
    ThreadingShim shim_;
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
    const std::optional<std::size_t> offset = step_length_offset();
    const unsigned threads = dWorldGetStepIslandsProcessingMaxThreadCount(world.ode_world());
    auto made = std::make_unique<ThreadingHook>(world, offset.value_or(0));
    world.add_observer(std::make_unique<Farewell>(*made));
    if (offset)
        made->install();
    if (!offset || !made->installed()) {
        static bool said = false;
        if (!said)
            report(format("dSoftWorldCreate: nothing tells this library of the world's steps, so "
                          "soft bodies would stand still; %s",
                          kCure));
        said = true;
    } else if (dWorldGetStepIslandsProcessingMaxThreadCount(world.ode_world()) != threads)
        report(format("dSoftWorldCreate: the world's thread pool had to be taken out to learn of "
                      "its steps, which now run on the calling thread; to keep it, %s",
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
