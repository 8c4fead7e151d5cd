#include "world/registry.h"

#include "base/error.h"
#include "world/soft_world.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

namespace ode::soft {
namespace {

std::mutex lock;
std::atomic<std::size_t> count{0};

std::vector<std::unique_ptr<SoftWorld>>& worlds() {
    static std::vector<std::unique_ptr<SoftWorld>> all;
    return all;
}

/// Takes the worlds that `matches` out of the registry; they end outside the lock, because their
/// observers may ask for other worlds.
template <class Predicate>
std::vector<std::unique_ptr<SoftWorld>> take(Predicate matches) {
    const std::lock_guard guard(lock);
    std::vector<std::unique_ptr<SoftWorld>> taken;
    std::erase_if(worlds(), [&](std::unique_ptr<SoftWorld>& w) {
        if (!matches(*w))
            return false;
        taken.push_back(std::move(w));
        return true;
    });
    count.store(worlds().size(), std::memory_order_release);
    return taken;
}

} // namespace

SoftWorld& create_world(dWorldID world, dSpaceID space) {
    if (find_world(world))
        throw InputError(
            "the ODE world has a soft world already; put all soft bodies into that one");
    auto made = std::make_unique<SoftWorld>(world, space);
    const std::lock_guard guard(lock);
    worlds().push_back(std::move(made));
    count.store(worlds().size(), std::memory_order_release);
    return *worlds().back();
}

void destroy_world(SoftWorld& world) noexcept {
    take([&](const SoftWorld& w) { return &w == &world; });
}

SoftWorld* find_world(dWorldID world) noexcept {
    if (count.load(std::memory_order_acquire) == 0)
        return nullptr;
    const std::lock_guard guard(lock);
    const auto found = std::find_if(worlds().begin(), worlds().end(),
                                    [&](const auto& w) { return w->ode_world() == world; });
    return found == worlds().end() ? nullptr : found->get();
}

void forget_world(dWorldID world) noexcept {
    if (count.load(std::memory_order_acquire) == 0)
        return;
    take([&](const SoftWorld& w) { return !world || w.ode_world() == world; });
}

void lose_space(dGeomID space) noexcept {
    if (count.load(std::memory_order_acquire) == 0)
        return;
    const std::lock_guard guard(lock);
    for (const auto& world : worlds())
        if (reinterpret_cast<dGeomID>(world->space()) == space)
            world->lose_space();
}

} // namespace ode::soft
