#pragma once

namespace ode::test {

/// What a soft plate that carries rigid bodies feels, through an unchanged ODE application whose
/// near callback makes contact joints.
struct PileRun {
    double weight;  ///< of the pile [N]
    double mean;    ///< of the force on the plate over the last part, step means [N]
    double ripple;  ///< largest departure from the mean, of substep forces [N]
    double lowest;  ///< gap that the lowest body's face has to the plate's at rest [m]
    double gain;    ///< most that the rigid bodies have energy above the first step's [J]
    double seconds; ///< of CPU
};

enum class Pile {
    box,   ///< 1 kg alone
    stack, ///< a box of 1 kg on a plate of 0.1 kg
    three, ///< 0.1, 0.3 and 1 kg on one another
};

/// @param h  ODE's step [s]. @param drop  gaps at the start [m]. @param seconds  of which the last
/// 0.1 are looked at.
PileRun run_pile(Pile pile, double h, double drop, double seconds);

} // namespace ode::test
