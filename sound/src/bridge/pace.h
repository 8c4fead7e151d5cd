#pragma once

#include "mix/scene.h"

#include <ode_softbody/softbody.h>

#include <string>
#include <string_view>
#include <vector>

namespace ode::sound {

/// What is done about a simulation slower than the loudspeaker.
class Pace {
public:
    enum class Policy { kStretch, kDropQuality };
    /// Name by name, in the order of the enumeration; empty past the last.
    static std::string_view name(int i) noexcept;

    /// Stretch gives bodies the tiers back that were taken from them.
    void set(Policy policy);
    Policy policy() const noexcept { return policy_; }

    /// Between steps. Each underrun after the last change of tiers has had time to show lowers
    /// those of all bodies that sound, in two stages: what moves node by node goes to "auto", and
    /// all goes to "modal".
    /// @param underruns  of all sinks so far.
    /// @param time       of the world [s].
    void update(Scene& scene, unsigned long underruns, double time);
    static constexpr double kPatience = 0.5; ///< for a change to show [s]

    void forget(dSoftBodyID body) noexcept;
    int stage() const noexcept { return stage_; } ///< 0: nothing dropped; 1; 2

private:
    struct Dropped {
        dSoftBodyID body;
        std::string was; ///< tier
        int stage;
    };
    void drop(dSoftBodyID body);

    Policy policy_ = Policy::kStretch;
    unsigned long underruns_ = 0;
    double changed_ = -kPatience; ///< [s]
    int stage_ = 0;
    std::vector<Dropped> dropped_;
};

} // namespace ode::sound
