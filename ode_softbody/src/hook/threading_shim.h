#pragma once

#include <ode/objects.h>
#include <ode/threading.h>
#include <ode/threading_impl.h>

namespace ode::soft {

/// What a world's threading implementation gets to know of its steps. Called on the stepping
/// thread.
class StepListener {
public:
    /// Islands are found, nothing has moved. @param context  ODE's own, on its stack.
    virtual void on_step_posted(const void* context) noexcept = 0;
    /// All islands are stepped; dWorldStep is about to return.
    virtual void on_step_done() noexcept = 0;
    /// The world ends, or gets another threading implementation.
    virtual void on_released() noexcept = 0;

protected:
    ~StepListener() = default;
};

/// A threading implementation that hands everything on to another one and tells of steps. ODE
/// announces them by the name of a call that it posts, the same since version 0.13.
class ThreadingShim {
public:
    /// Before one that runs everything on the calling thread, as ODE's default does.
    explicit ThreadingShim(StepListener& listener);
    /// Before one that is somebody else's.
    ThreadingShim(StepListener& listener, const dThreadingFunctionsInfo* functions,
                  dThreadingImplementationID behind) noexcept
        : listener_(listener), real_(behind), call_(functions) {}
    ~ThreadingShim(); ///< no world may have it any more
    ThreadingShim(const ThreadingShim&) = delete;
    ThreadingShim& operator=(const ThreadingShim&) = delete;

    bool usable() const noexcept { return real_ != nullptr; }
    void give_to(dWorldID world) noexcept;
    static const dThreadingFunctionsInfo* functions() noexcept;
    dThreadingImplementationID id() noexcept {
        return reinterpret_cast<dThreadingImplementationID>(this);
    }

private:
    struct Forward;

    StepListener& listener_;
    dThreadingImplementationID real_; ///< does the work
    const dThreadingFunctionsInfo* call_;
    bool own_ = false;            ///< real_ is to be freed
    const char* group_ = nullptr; ///< address of the name, once met
};

} // namespace ode::soft
