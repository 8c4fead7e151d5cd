#pragma once

#include "scenes/world.h"

namespace scenes {

/// A weight that strikes once, as a player's hand lets it: a ball, a body of ODE's, which meets the
/// soft body within a step or some and is taken away as soon as the two have parted.
class Mallet {
public:
    /// @param at     centre at the start [m]
    /// @param speed  [m/s], in a straight line: gravity doesn't touch it
    Mallet(World& world, double mass, double radius, const dVector3 at, const dVector3 velocity);
    Mallet(const Mallet&) = delete;
    Mallet& operator=(const Mallet&) = delete;

    /// Before every step.
    void watch();
    bool has_struck() const { return struck_; }

private:
    dBodyID body_;
    dGeomID geom_;
    dVector3 start_, last_; ///< its velocity [m/s]
    bool struck_ = false;
};

} // namespace scenes
