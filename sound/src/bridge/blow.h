#pragma once

#include "bridge/rigid_touch.h"

#include <optional>

namespace ode::sound {

/// How a contact has been before the present step.
enum class Acquaintance {
    kNew,    ///< nothing touched there lately
    kParted, ///< it did within the last Blow::kFlutter steps, but not in the one before
    kLasting ///< it did in the step before
};

/// How a contact is known, and what it has borne.
struct History {
    Acquaintance acquaintance = Acquaintance::kNew;
    double load = 0.0; ///< along the normal, mean of the last steps [N]
    int steps = 0;     ///< that it has lasted
};

/// What a contact joint does in a step that is to be heard as a stroke.
struct Blow {
    static constexpr double kFlutter = 6.0; ///< steps

    double time;   ///< when it fell [s]
    double speed;  ///< of closing then [m/s]
    double mass;   ///< effective, of both along the normal [kg]
    Vec3 impulse;  ///< on the first body [N s]
    double energy; ///< that motion loses by it, and vibration may get at most [J]
    bool goes_on;  ///< the stroke takes more than one step: it is a push
    bool passed;   ///< it fell elsewhere and went on through a contact that was there already
};

/// Nothing for a contact that merely bears load: ODE gives the load of a step at once, so that what
/// is heard of a contact at rest would be steps of ODE's. What bears is told from what strikes by
/// how fast it closes before the step. A body at rest loses touch for a step or a few, rocks and
/// comes back at the speed that it falls in as many: bounces too short for ODE's step are no news.
/// A blow that ODE's solver passes on through a contact which bears (Newton's cradle) closes
/// nothing there: it is told by an impulse far beyond what the contact has borne.
/// @param begin  of the step [s].  @param h  its length.  @param before  of the step before it.
std::optional<Blow> find_blow(const RigidTouch& touch, const History& history, double begin,
                              double h, double before) noexcept;

} // namespace ode::sound
