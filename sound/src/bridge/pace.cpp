#include "bridge/pace.h"

#include <ode_softbody/tier.h>

#include <algorithm>
#include <array>

namespace ode::sound {
namespace {

constexpr std::array<std::string_view, 2> kNames = {"stretch", "drop quality"};

} // namespace

std::string_view Pace::name(int i) noexcept {
    const auto at = static_cast<std::size_t>(i);
    return at < kNames.size() ? kNames[at] : std::string_view{};
}

void Pace::set(Policy policy) {
    policy_ = policy;
    if (policy != Policy::kStretch)
        return;
    for (const Dropped& own : dropped_)
        dSoftBodySetTier(own.body, own.was.c_str());
    dropped_.clear();
    stage_ = 0;
}

void Pace::update(Scene& scene, unsigned long underruns, double time) {
    constexpr int kStages = 2;
    const bool late = underruns > underruns_;
    underruns_ = underruns;
    if (policy_ == Policy::kStretch)
        return;
    if (late && stage_ < kStages && time >= changed_ + kPatience) {
        ++stage_;
        changed_ = time;
    }
    if (stage_ == 0)
        return;
    scene.for_each_body([&](const void* key, const BodySource&) {
        drop(static_cast<dSoftBodyID>(const_cast<void*>(key)));
    });
}

void Pace::drop(dSoftBodyID body) {
    const auto found = std::find_if(dropped_.begin(), dropped_.end(),
                                    [&](const Dropped& own) { return own.body == body; });
    if (found != dropped_.end() && found->stage == stage_)
        return;
    const char* const tier = dSoftBodyGetTier(body);
    if (!tier)
        return;
    if (found == dropped_.end())
        dropped_.push_back({body, tier, stage_});
    else
        found->stage = stage_;
    if (stage_ > 1 || std::string_view(tier) == "explicit")
        dSoftBodySetTier(body, stage_ > 1 ? "modal" : "auto");
}

void Pace::forget(dSoftBodyID body) noexcept {
    std::erase_if(dropped_, [&](const Dropped& own) { return own.body == body; });
}

} // namespace ode::sound
