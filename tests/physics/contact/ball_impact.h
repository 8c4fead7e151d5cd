#pragma once

#include "couple/node_contact.h"
#include "integrate/node_state.h"
#include "model/make_model.h"

#include <memory>

namespace ode::soft {

/// Of an impact: how long it bears, the largest force, what is kept.
struct Impact {
    double seconds;
    double peak;         ///< [N]
    double energy_error; ///< after it, of the energy before; 0 for closed forms
};

/// Hertz's, for a reduced mass. @param modulus  E* [Pa]
Impact hertz_impact(double mass, double radius, double modulus, double speed);

/// A cube of `cells`^3 cells of which the one under the middle of the top has the size `cell`.
TetMesh graded_block(double side, int cells, double cell);

struct RigidBall {
    double radius;
    double mass;
    double speed;
    Vec3 over;         ///< point of the top that it meets, x y
    double compliance; ///< ContactLaw::rigid_compliance
};

/// One free, undamped soft body of the default element, 0.9 of its critical step.
class SoftSide {
public:
    SoftSide(TetMesh mesh, const Solid& solid);

    double mass() const;
    Impact strike(const RigidBall& ball);
    /// @param corners  of a triangle of the surface whose middle is lowest: 1, 2 or 3.
    /// @param longest  simulated [s]
    Impact drop_on_floor(double speed, double radius, int corners, double longest);

private:
    Impact run(const RigidShape& shape, const ContactLaw& law, RigidShadow& rigid, double longest);
    double energy(const RigidShadow& rigid) const;

    TetMesh mesh_;
    Surface surface_;
    std::unique_ptr<ElasticModel> model_;
    SurfaceNodes nodes_;
    std::vector<double> inverse_mass_;
    NodeState state_;
    NodeArray force_;
    double dt_;
    double rigid_mass_ = 0;
};

} // namespace ode::soft
