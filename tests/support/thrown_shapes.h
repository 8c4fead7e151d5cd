#pragma once

namespace ode::test {

enum class Shape { sphere, box, capsule, cylinder };
const char* name_of(Shape shape) noexcept;

/// What the impact of a rigid body on a free, undamped, frictionless soft plate keeps, through
/// ODE's steps of 4 ms: without gravity, so that energy and momenta of both are constant.
struct ShapeOutcome {
    double change;   ///< of energy, in steps with contact [-]
    double highest;  ///< the same, at the end of a step [-]
    double momentum; ///< likewise, of what moved at first; without contact ODE
    double angular;  ///< alone moves the body, whose spin errs by more
    double seconds;  ///< CPU, looking at the energy included
    double substeps;
};

/// 0.3 kg, turned and spinning at random, at 1 m/s.
ShapeOutcome throw_shape(Shape shape, unsigned seed);

} // namespace ode::test
