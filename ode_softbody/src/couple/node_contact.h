#pragma once

#include "collide/rigid_shape.h"
#include "couple/contact_law.h"
#include "couple/node_forces.h"
#include "couple/pole_contact.h"
#include "couple/rigid_shadow.h"
#include "couple/sample_contact.h"
#include "couple/surface_nodes.h"
#include "couple/surface_probe.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace ode::soft {

/// Work done in one call.
struct ContactTally {
    unsigned long tests = 0;   ///< nodes whose distance was evaluated
    unsigned long bearing = 0; ///< nodes that bore force
};

/// Contact of one soft body with one rigid shape: of its surface nodes with the shape, and of the
/// shape's samples with its triangles (SampleContact). Kept from step to step as long as the pair
/// stays near, because friction has a memory.
///
/// Normal force of node i: a one-sided spring k_i = kappa A_i by its discrete gradient, so that an
/// impact keeps its energy at any substep, and a dashpot (NormalContact). Depth is that of the
/// closest surface point, continuous over edges and corners, so the force has a potential and needs
/// no cap on depth. Friction is explicit: its stability bounds k_i by kStiffnessShare of what the
/// node's mass bears at this substep, and c_i likewise; a light rigid body lowers both
/// (RigidShadow::softening).
///
/// A node that is in stays on the side where it came in: the far side of a thin shape doesn't push
/// it through.
///
/// Friction: a spring of 0.7 k_i from a point that is fixed to the shape, clamped to mu F_n, with a
/// dashpot; then the sum is clamped. The spring alone moves the anchor (clamping by the total would
/// push forward after a stop).
///
/// Node and shape get opposite forces at one point, the node: linear and angular momentum of the
/// pair are kept to rounding.
class NodeContact {
public:
    /// @param nodes  borrowed for the contact's life. Allocates all it will ever need.
    /// @param geom   names the pair; never dereferenced but through a probed shape.
    NodeContact(const SurfaceNodes& nodes, dGeomID geom);

    dGeomID geom() const noexcept { return geom_; }

    /// Start of a step. Anchors are kept unless the shape has become another one.
    /// @param inverse_mass  of every mesh node [1/kg]; 0: held, so that its mass bounds nothing.
    void begin_step(const RigidShape& shape, const ContactLaw& law,
                    std::span<const double> inverse_mass, double dt);

    /// Adds contact forces to `force` [N], which holds everything else that acts on the nodes, and
    /// their reaction to `rigid`. Looks for nodes near the
    /// shape anew whenever they may have come within reach since it looked last.
    ContactTally add_force(const NodeArray& position, const NodeArray& velocity, RigidShadow& rigid,
                           double dt, const NodeForces& force) noexcept;

    /// Remembers the start of a step, and goes back to it when the step is redone.
    void keep();
    void take_back() noexcept;

    /// Some node bore force in the last substep.
    bool bearing() const noexcept { return bearing_ != 0; }
    /// What a light body's shadow asked of the contact in the last substep, to be handed to the
    /// shadow of the next step; 1 when nothing bears.
    double softening() const noexcept { return softening_; }

private:
    void find_candidates(const NodeArray& position, const NodeArray& velocity,
                         const RigidMotion& motion) noexcept;
    /// The same for probed shapes: planes_ run parallel to candidate_.
    void probe_candidates(const NodeArray& position, const NodeArray& velocity,
                          const RigidMotion& motion) noexcept;

    void prepare_points();

    void schedule_look(double nearest, double fastest) noexcept;

    /// A node inside the shape.
    struct Touch {
        int node;    ///< of the surface
        Vec3 local;  ///< where it is in the shape's frame [m]
        Vec3 across; ///< outward normal in the shape's frame
        Vec3 normal; ///< the same in the world's
        double depth;
    };

    /// Fills touch_. @return what the contacts ask of the rigid body's stability.
    template <class Distance>
    double find_touching(Distance distance_of, const NodeArray& position, const NodeArray& velocity,
                         const RigidShadow& rigid, double dt) noexcept;
    double find_touching_planes(const NodeArray& position, const NodeArray& velocity,
                                const RigidShadow& rigid, double dt) noexcept;
    void push(const NodeArray& position, const NodeArray& velocity, RigidShadow& rigid, double dt,
              const NodeForces& force) noexcept;

    const SurfaceNodes& nodes_;
    dGeomID geom_;
    RigidShape shape_;
    std::vector<Vec3> corners_;       ///< of a convex
    std::vector<TangentPlane> faces_; ///< of a convex
    ContactLaw law_;
    bool is_prepared_ = false;
    // Per surface node:
    std::vector<double> stiffness_; ///< [N/m]
    std::vector<double> damping_;   ///< [N s/m]
    std::vector<double> recess_; ///< depth that point contacts take up [m]; empty: there are none
    std::vector<Vec3> anchor_;   ///< end of the friction spring, in the shape's frame [m]
    std::vector<std::uint8_t> anchored_; ///< whether there is one
    std::vector<Vec3> entered_;          ///< outward normal where it is in, in the shape's frame
    std::vector<Overlap> overlap_;
    std::vector<int> candidate_; ///< surface nodes near the shape
    std::vector<Touch> touch_;   ///< of the last substep
    SampleContact samples_;
    PoleContact poles_;
    struct Planes {
        int count;
        std::array<TangentPlane, SurfaceProbe::kMostPlanes> plane;
    };
    std::unique_ptr<SurfaceProbe> probe_; ///< of a probed shape
    std::vector<Planes> planes_;
    std::span<const double> inverse_mass_; ///< of every mesh node [1/kg]; borrowed for the step
    double look_again_in_ = 0;             ///< [s]
    std::size_t bearing_ = 0;
    double softening_ = 1; ///< in the last substep
    struct Memory {
        std::vector<Vec3> anchor, entered;
        std::vector<std::uint8_t> anchored;
        std::vector<Overlap> overlap;
        std::size_t bearing = 0;
        double softening = 1;
    } kept_; ///< of the start of the step
};

} // namespace ode::soft
