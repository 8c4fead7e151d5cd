#pragma once

#include "couple/node_contact.h"
#include "integrate/node_state.h"
#include "model/stvk_linear.h"

#include <ode/ode.h>

#include <memory>
#include <string>

namespace ode::soft {

/// Rigid shapes made of the kinds of geom that ODE has for moving bodies.
enum class Thrown { sphere, box, capsule, cylinder, convex, trimesh };
constexpr Thrown kThrown[] = {Thrown::sphere,   Thrown::box,    Thrown::capsule,
                              Thrown::cylinder, Thrown::convex, Thrown::trimesh};
const char* name_of(Thrown kind) noexcept;

struct Throw {
    Thrown kind = Thrown::box;
    double size = 0.03; ///< about half of the largest side [m]
    double mass = 0.3;  ///< [kg]
    Vec3 at = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
    Quat turn = Quat::Identity();
    Vec3 spin = Vec3::Zero();
    double friction = 0;
    double damping = 0; ///< [s]
    double seconds = 0.04;
};

struct Outcome {
    double energy;   ///< at the end, of the initial energy, less one
    double most;     ///< the same, at its highest on the way, springs not counted
    double depth;    ///< deepest corner or ball point below the face that it fell on [m]
    Vec3 velocity;   ///< of the rigid body at the end [m/s]
    double momentum; ///< change of the pair's, relative
    double bearing;  ///< contact points that bore force, summed over the substeps
};

/// A free, elastic, undamped soft body whose upper face is at z = 0, and what is thrown on it.
/// Without gravity and without ODE's steps: substeps alone.
class ThrownScene {
public:
    ThrownScene(TetMesh mesh, double young, double density, double dt);
    ~ThrownScene();
    ThrownScene(const ThrownScene&) = delete;
    ThrownScene& operator=(const ThrownScene&) = delete;

    /// Of the rest of the body, each time anew.
    Outcome run(const Throw& what);

    double soft_mass() const;

private:
    dGeomID make_geom(const Throw& what, dMass& mass);
    /// Height of the upper face at p, from the triangle above or below it.
    double face_height(const Vec3& p) const;

    double dt_;
    TetMesh mesh_;
    Surface surface_;
    StvkLinear model_;
    SurfaceNodes nodes_;
    NodeState state_;
    NodeArray force_;
    std::vector<double> inverse_mass_;
    dWorldID world_;
};

} // namespace ode::soft
