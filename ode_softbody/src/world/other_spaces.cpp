#include "world/other_spaces.h"

#include "collide/soft_geom.h"

#include <algorithm>
#include <atomic>
#include <mutex>

namespace ode::soft {
namespace {

std::mutex lock;
std::atomic<std::size_t> kept{0};

std::vector<OtherSpaces*>& owners() {
    static std::vector<OtherSpaces*> all;
    return all;
}

} // namespace

OtherSpaces::~OtherSpaces() { clear(); }

void OtherSpaces::add(dGeomID soft, dGeomID space_or_geom) {
    const std::lock_guard guard(lock);
    for (const Pair& pair : pair_)
        if (pair.soft == soft && pair.other == space_or_geom)
            return;
    if (pair_.empty())
        owners().push_back(this);
    pair_.push_back({soft, space_or_geom});
    ++kept;
}

void OtherSpaces::clear() noexcept {
    if (kept.load(std::memory_order_acquire) == 0)
        return;
    const std::lock_guard guard(lock);
    kept -= pair_.size();
    pair_.clear();
    std::erase(owners(), this);
}

void OtherSpaces::collide() const noexcept {
    for (const Pair& pair : pair_)
        collide_with(pair.soft, pair.other);
}

void forget_space(dGeomID space_or_geom) noexcept {
    if (kept.load(std::memory_order_acquire) == 0)
        return;
    const std::lock_guard guard(lock);
    for (OtherSpaces* owner : owners())
        kept -= std::erase_if(owner->pair_, [&](const OtherSpaces::Pair& pair) {
            return pair.soft == space_or_geom || pair.other == space_or_geom;
        });
}

} // namespace ode::soft
