#pragma once

#include "collide/rigid_shape.h"
#include "couple/contact_law.h"
#include "couple/node_forces.h"
#include "couple/pole_contact.h"
#include "couple/rigid_push.h"
#include "couple/rigid_shadow.h"
#include "couple/rough_places.h"
#include "couple/sample_contact.h"
#include "couple/surface_nodes.h"
#include "couple/surface_probe.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
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
/// no cap on depth. All normal forces on a rigid body are found together (RigidResponse). Friction
/// is explicit: its stability bounds k_i by kStiffnessShare of what the node's mass bears at this
/// substep, and c_i likewise; a light rigid body lowers friction's (RigidShadow::softening).
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

    /// A substep: finds what touches or may, announces its friction to `rigid`. Looks for nodes
    /// near the shape anew whenever they may have come within reach since it looked last.
    /// @return tests done.
    unsigned long find(const NodeArray& position, const NodeArray& velocity, RigidShadow& rigid,
                       double dt) noexcept;
    /// What find() does first, on its own: a time for which nothing can touch may come of it.
    bool is_look_due() const noexcept { return look_again_in_ <= 0; }
    /// @param rough  null: nodes are where `position` says.
    unsigned long look(const NodeArray& position, const NodeArray& velocity,
                       const RigidShadow& rigid, RoughPlaces* rough = nullptr) noexcept;
    void look_soon() noexcept { look_again_in_ = 0; }
    /// How fast candidates come at the shape, at the last looks [m/s].
    double closing_speed() const noexcept { return closing_; }
    /// Nodes that may get in within such a time are candidates: the shorter, the fewer, and the
    /// more looks. 0: those that are near [s].
    void set_horizon(double time) noexcept { horizon_ = time; }
    /// For so long no node can touch the shape, and pass() may stand for find() [s].
    double quiet_for() const noexcept { return bearing_ == 0 ? std::max(quiet_in_, free_in_) : 0; }
    /// Another contact, or this, has pushed the body: its flight is not what was foreseen.
    void note_push() noexcept { free_in_ = wide_free_in_ = 0; }
    void pass(double dt) noexcept;
    /// The mesh nodes whose motion find() and what follows ask for until the next look; some more
    /// than once.
    void collect_nodes(std::vector<int>& out) const;

    bool is_touching() const noexcept {
        return (at_once_ && !candidate_.empty()) || !touch_.empty() || samples_.is_touching() ||
               poles_.is_touching();
    }
    /// Where the rigid body can't be moved, nodes share nothing: each gets its force in one go.
    /// @param felt  gets what the rigid body does, unless null.
    void push_at_once(const NodeArray& position, const TouchForces& on, RigidShadow& rigid,
                      std::vector<RigidPush>* felt) noexcept;
    /// Then normal forces, as often as other forces change: brings each in line with all that acts
    /// on the nodes and on the rigid body. @param on  with what the last sweep added.
    void sweep(const TouchForces& on, RigidResponse& rigid) noexcept;
    /// Friction, once the normal forces are known. @return points that bear.
    std::size_t drag(const TouchForces& on, RigidShadow& rigid) noexcept;

    /// Last, where the rigid body moves: books what the springs did.
    void enter_books(const TouchForces& on, const RigidResponse& rigid) noexcept;

    /// use(point [m], force [N]): what the rigid body gets at each place by sweep() and drag().
    template <class Use>
    void each_push(Use use) const {
        for (const Touch& touch : touch_)
            use(touch.at, Vec3(-touch.press.force * touch.normal - touch.grip));
        samples_.each_push(use);
        poles_.each_push(use);
    }

    /// All of it, where the rigid body meets nothing else: adds contact forces to `force` [N],
    /// which holds everything else that acts on the nodes, and their reaction to `rigid`.
    ContactTally add_force(const NodeArray& position, const NodeArray& velocity, RigidShadow& rigid,
                           double dt, const NodeForces& force) noexcept;

    /// Remembers the start of a step, and goes back to it when the step is redone.
    void keep();
    void take_back() noexcept;

    bool has_friction() const noexcept { return law_.friction > 0; }
    /// Some node bore force in the last substep.
    bool bearing() const noexcept { return bearing_ != 0; }
    /// What a light body's shadow asked of the contact in the last substep, to be handed to the
    /// shadow of the next step; 1 when nothing bears.
    double softening() const noexcept { return softening_; }

private:
    static constexpr double kReach = 0.5; ///< of the shape, in mean edges: a node is a candidate

    void find_candidates(const NodeArray& position, const NodeArray& velocity,
                         const RigidMotion& motion) noexcept;
    /// The same of a body whose nodes are brought up to date here.
    void find_candidates(const NodeArray& position, const NodeArray& velocity,
                         const RigidShadow& rigid, RoughPlaces& rough) noexcept;
    /// A node near a shape that stands still.
    struct Approach {
        int node;
        double gap, closing;    ///< where it is [m], [m/s]
        double acceleration;    ///< towards the shape, at most [m/s^2]
        double least_gap;       ///< to where it is carried, however it swings [m]
        double carried_closing; ///< [m/s]
    };
    const Approach& approach_of(int node, const NodeArray& position, const NodeArray& velocity,
                                const Pose& pose, RoughPlaces& rough) noexcept;
    /// Shortens free_in_ by what candidates, and the curved surface round them, need to touch.
    void foresee(const NodeArray& position, const NodeArray& velocity, const Pose& pose,
                 RoughPlaces& rough) noexcept;
    /// Which samples and poles, once the candidates are known.
    /// @param near  whether any node is within `reach` of the shape or two edges more.
    void find_points(const NodeArray& position, const Pose& pose, bool near, double reach) noexcept;
    /// How fast the shape may move against the nodes by its turning [m/s].
    double sweeping(const RigidMotion& motion) const noexcept;
    /// The same for probed shapes: planes_ run parallel to candidate_.
    void probe_candidates(const NodeArray& position, const NodeArray& velocity,
                          const RigidMotion& motion) noexcept;

    /// With what ODE has to be asked for: of a convex geom, and of a trimesh that is convex.
    RigidShape known_shape(const RigidShape& shape);
    void prepare_points();

    /// Whether its bulge, not the node, meets the shape.
    bool has_pole(std::size_t node) const noexcept {
        return !recess_.empty() && shape_.kind != ShapeKind::sphere && nodes_.shape.bulges(node);
    }
    static double time_to_cross(double gap, double haste) noexcept; ///< at least [s]

    /// A node inside the shape.
    struct Touch {
        int node;                 ///< of the surface
        Vec3 local;               ///< where it is in the shape's frame [m]
        Vec3 across;              ///< outward normal in the shape's frame
        Vec3 normal;              ///< the same in the world's
        double depth;             ///< [m]
        Vec3 at;                  ///< world [m]
        Vec3 slip;                ///< of the node against the shape, half a substep ago [m/s]
        double owed = 0;          ///< see EnergyBook [J]
        Press press = {};         ///< so far
        Vec3 grip = Vec3::Zero(); ///< friction on the node [N]
    };

    /// Whether a candidate is in, or may be within the substep; keeps its memory of both.
    /// @param gap  out.
    template <class Distance>
    [[gnu::always_inline]] bool may_touch(Distance distance_of, std::size_t node, const Vec3& local,
                                          const Vec3& slip, const Mat3& rotation, double dt,
                                          SurfaceDistance& gap) noexcept;
    /// Fills touch_. @return what friction asks of the rigid body's stability.
    double find_touching(const NodeArray& position, const NodeArray& velocity,
                         const RigidShadow& rigid, double dt) noexcept;
    double find_touching_planes(const NodeArray& position, const NodeArray& velocity,
                                const RigidShadow& rigid, double dt) noexcept;
    void touch(Touch touch, const RigidShadow& rigid, double dt) noexcept;
    double grip_load(std::size_t node, const Vec3& x, const Vec3& normal, double dt,
                     const RigidShadow& rigid) const noexcept;
    /// Friction of a node that bears. @param across  the normal in the shape's frame.
    /// @param led  mean velocity over the substep with all force but this, where there is a joint
    ///             inertia, else null [m/s].
    Vec3 grip_of(std::size_t node, const Vec3& local, const Vec3& across, const Vec3& slip,
                 const Vec3& normal, double press, const Mat3& rotation, const TouchForces& on,
                 const Vec3& base, const Vec3* led) noexcept;

    const SurfaceNodes& nodes_;
    dGeomID geom_;
    RigidShape shape_;
    std::vector<Vec3> corners_;       ///< of what is convex
    std::vector<TangentPlane> faces_; ///< the same's
    ContactLaw law_;
    bool is_prepared_ = false;
    bool at_once_ = false;   ///< nodes touch in push_at_once() alone
    bool backwards_ = false; ///< in what order, from substep to substep
    // Per surface node:
    std::vector<double> stiffness_; ///< [N/m]
    std::vector<double> damping_;   ///< [N s/m]
    std::vector<double> recess_; ///< depth that point contacts take up [m]; empty: there are none
    std::vector<Vec3> anchor_;   ///< end of the friction spring, in the shape's frame [m]
    std::vector<std::uint8_t> anchored_; ///< whether there is one
    std::vector<Vec3> entered_;          ///< outward normal where it is in, in the shape's frame
    std::vector<Overlap> overlap_;
    std::vector<EnergyBook> book_;
    std::vector<int> candidate_; ///< surface nodes near the shape
    std::vector<Touch> touch_;   ///< of the last substep
    RigidResponse response_;     ///< of add_force()
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
    struct Seen {                          ///< of what a body's frame carries
        double distance, closing, speed;
        Vec3 normal; ///< world
    };
    std::vector<Seen> seen_;         ///< scratch: of groups, in the last look
    std::vector<Approach> approach_; ///< scratch: of the last look
    std::vector<int> wide_;          ///< groups that looks go over, where they may leave out some
    double look_wide_in_ = 0;        ///< all are gone over [s]
    double closing_ = 0;             ///< [m/s]
    double horizon_ = 0;             ///< candidates may get in within it; 0: are within kReach [s]
    double quiet_in_ = 0;            ///< nothing can touch for so long [s]
    double free_in_ = 0;             ///< nor, if nothing pushes the body, for so long [s]
    double wide_free_in_ = 0;        ///< the same of what wide_ leaves out [s]
    std::size_t bearing_ = 0;
    double softening_ = 1; ///< in the last substep
    bool changed_ = true;  ///< since keep()
    struct Memory {
        std::vector<Vec3> anchor, entered;
        std::vector<std::uint8_t> anchored;
        std::vector<Overlap> overlap;
        std::vector<EnergyBook> book;
        std::size_t bearing = 0;
        double softening = 1;
    } kept_; ///< of the start of the step
};

} // namespace ode::soft
