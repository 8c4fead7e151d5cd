#pragma once

#include "collide/closest_point.h"
#include "couple/contact_law.h"
#include "couple/rigid_samples.h"
#include "couple/rigid_shadow.h"
#include "couple/surface_nodes.h"

#include <span>
#include <vector>

namespace ode::soft {

/// Contact of a rigid shape's samples with a soft body's triangles: what keeps corners, edges and
/// small balls from slipping between nodes. Owned by NodeContact, which see for force law and
/// stability; here a ball bears where it overlaps the surface point closest to its centre. That
/// distance is continuous as the point moves over faces, edges and vertices, so the force has a
/// potential. It is signed by the feature's pseudonormal.
///
/// A sample that was seen outside before may be at any depth; one first seen inside counts only
/// down to a quarter of an edge, so that nothing deep in a body is thrown out of it. Once it bears,
/// only triangles facing as before are its surface: a thin plate's far side doesn't pull it
/// through.
class SampleContact {
public:
    explicit SampleContact(const SurfaceNodes& surface) : surface_(surface) {}

    void begin_step(const RigidShape& shape, const ContactLaw& law, double dt);

    /// Pairs samples with triangles no farther than `reach` [m] from them.
    void look(const NodeArray& position, const Pose& shape, double reach);

    /// The surface is out of every sample's reach.
    void look_away() noexcept;

    /// Fills touch_. @return what the contacts ask of the rigid body's stability; tests are added
    /// up.
    double find_touching(const NodeArray& position, const NodeArray& velocity,
                         const RigidShadow& rigid, const Pose& in_body, double dt,
                         unsigned long& tests) noexcept;
    /// Adds the forces of the contacts found. @return how many bore one.
    std::size_t push(const NodeArray& velocity, std::span<const double> inverse_mass,
                     double softening, double dt, RigidShadow& rigid, NodeArray& force) noexcept;

    bool is_touching() const noexcept { return !touch_.empty(); }
    double reach() const noexcept; ///< of the farthest sample from the shape's origin [m]
    bool is_near() const noexcept { return !near_.empty(); }
    void forget() noexcept;

private:
    struct State {
        bool bears = false;
        bool was_outside = false;
        Vec3 normal = Vec3::Zero();  ///< of the soft surface, outward, world
        Vec3 stretch = Vec3::Zero(); ///< of the friction spring, world [m]
        double stiffness;            ///< never rises while it bears [N/m]
    };
    struct Near { ///< a sample and its range of pair_
        int sample;
        int first;
        int last;
    };
    struct Touch {
        int sample;
        int triangle;
        TrianglePoint at;
        double depth;
    };
    struct Closest {
        int triangle = -1;
        TrianglePoint at;
        double distance2;
    };

    /// Velocity of the rigid sample against the soft surface [m/s].
    Vec3 slip_of(const Closest& closest, const NodeArray& velocity,
                 const RigidMotion& motion) const noexcept;
    Closest find_closest(const Near& near, const Vec3& center, const State& state,
                         const NodeArray& position) const noexcept;

    const SurfaceNodes& surface_;
    RigidShape shape_;
    ContactLaw law_;
    double dt_ = 0;
    double spacing_ = 0; ///< [m]
    std::vector<RigidSample> sample_;
    std::vector<State> state_;
    std::vector<Near> near_;
    std::vector<int> pair_; ///< triangles
    std::vector<Touch> touch_;
    std::size_t bearing_ = 0;
};

} // namespace ode::soft
