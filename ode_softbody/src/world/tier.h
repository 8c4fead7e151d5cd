#pragma once

#include <span>
#include <string_view>

namespace ode::soft {

/// How a body's motion is computed, as the application asks for it.
enum class TierChoice {
    explicit_space, ///< every node, substep by substep: any strain, and what other tiers are judged
                    ///< by
    modes,          ///< its vibration modes in a frame that moves with it, wherever they can be had
    cubic,          ///< modes with what isn't linear of them up to the fourth power of amplitude
    automatic,      ///< modes while they are right to tolerance, else every node
};

struct TierName {
    std::string_view name;
    TierChoice choice;
};

inline constexpr TierName kTierNames[] = {{"explicit", TierChoice::explicit_space},
                                          {"modal", TierChoice::modes},
                                          {"cubic", TierChoice::cubic},
                                          {"auto", TierChoice::automatic}};

} // namespace ode::soft
