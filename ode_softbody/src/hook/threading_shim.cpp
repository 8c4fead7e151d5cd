#include "hook/threading_shim.h"

#include <cstring>

namespace ode::soft {
namespace {

constexpr const char* kGroup = "World Islands Stepping Group";
constexpr const char* kWait = "World Islands Stepping Wait";

bool is(const char* name, const char* wanted) noexcept {
    return name && std::strcmp(name, wanted) == 0;
}

} // namespace

/// ODE's calls, handed on to the real implementation.
struct ThreadingShim::Forward {
    static ThreadingShim& at(dThreadingImplementationID id) noexcept {
        return *reinterpret_cast<ThreadingShim*>(id);
    }
    static dMutexGroupID alloc_mutex_group(dThreadingImplementationID id, dmutexindex_t count,
                                           const char* const* names) {
        return at(id).call_->alloc_mutex_group(at(id).real_, count, names);
    }
    static void free_mutex_group(dThreadingImplementationID id, dMutexGroupID group) {
        at(id).call_->free_mutex_group(at(id).real_, group);
    }
    static void lock(dThreadingImplementationID id, dMutexGroupID group, dmutexindex_t i) {
        at(id).call_->lock_group_mutex(at(id).real_, group, i);
    }
    static void unlock(dThreadingImplementationID id, dMutexGroupID group, dmutexindex_t i) {
        at(id).call_->unlock_group_mutex(at(id).real_, group, i);
    }
    static dCallWaitID alloc_wait(dThreadingImplementationID id) {
        return at(id).call_->alloc_call_wait(at(id).real_);
    }
    static void reset_wait(dThreadingImplementationID id, dCallWaitID wait) {
        at(id).call_->reset_call_wait(at(id).real_, wait);
    }
    static void free_wait(dThreadingImplementationID id, dCallWaitID wait) {
        at(id).call_->free_call_wait(at(id).real_, wait);
        at(id).listener_.on_released();
    }
    static void post(dThreadingImplementationID id, int* fault, dCallReleaseeID* releasee,
                     ddependencycount_t dependencies, dCallReleaseeID dependent, dCallWaitID wait,
                     dThreadedCallFunction* function, void* context, dcallindex_t index,
                     const char* name) {
        ThreadingShim& shim = at(id);
        if (shim.group_ ? name == shim.group_ : is(name, kGroup)) {
            shim.group_ = name;
            shim.listener_.on_step_posted(context);
        }
        shim.call_->post_call(shim.real_, fault, releasee, dependencies, dependent, wait, function,
                              context, index, name);
    }
    static void alter(dThreadingImplementationID id, dCallReleaseeID releasee,
                      ddependencychange_t change) {
        at(id).call_->alter_call_dependencies_count(at(id).real_, releasee, change);
    }
    static void wait(dThreadingImplementationID id, int* status, dCallWaitID wait,
                     const dThreadedWaitTime* timeout, const char* name) {
        ThreadingShim& shim = at(id);
        shim.call_->wait_call(shim.real_, status, wait, timeout, name);
        if (is(name, kWait))
            shim.listener_.on_step_done();
    }
    static unsigned thread_count(dThreadingImplementationID id) {
        return at(id).call_->retrieve_thread_count(at(id).real_);
    }
    static int preallocate(dThreadingImplementationID id, ddependencycount_t calls) {
        return at(id).call_->preallocate_resources_for_calls(at(id).real_, calls);
    }
};

ThreadingShim::ThreadingShim(StepListener& listener)
    : listener_(listener), real_(dThreadingAllocateSelfThreadedImplementation()),
      call_(real_ ? dThreadingImplementationGetFunctions(real_) : nullptr), own_(true) {}

ThreadingShim::~ThreadingShim() {
    if (own_ && real_)
        dThreadingFreeImplementation(real_);
}

const dThreadingFunctionsInfo* ThreadingShim::functions() noexcept {
    static const dThreadingFunctionsInfo functions = {sizeof(dThreadingFunctionsInfo),
                                                      &Forward::alloc_mutex_group,
                                                      &Forward::free_mutex_group,
                                                      &Forward::lock,
                                                      &Forward::unlock,
                                                      &Forward::alloc_wait,
                                                      &Forward::reset_wait,
                                                      &Forward::free_wait,
                                                      &Forward::post,
                                                      &Forward::alter,
                                                      &Forward::wait,
                                                      &Forward::thread_count,
                                                      &Forward::preallocate};
    return &functions;
}

void ThreadingShim::give_to(dWorldID world) noexcept {
    dWorldSetStepThreadingImplementation(world, functions(), id());
}

} // namespace ode::soft
