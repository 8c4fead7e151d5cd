#pragma once

#include "collide/rigid_shape.h"
#include "couple/triangle_touch.h"

#include <array>
#include <span>
#include <vector>

namespace ode::soft {

/// Largest value of a.w + sum of w_j w_k b_i over a triangle. @param w  out: where, corner weights.
double highest_point(const Vec3& a, const std::array<double, 3>& b, Vec3& w) noexcept;

/// Contact of a soft body's bulges with a rigid shape's flat faces, as of the curved surface that
/// the facets stand for: a ball of facets meets a floor in one point, on whichever facet, edge or
/// node it lies, and yields there by Hertz's law less the mesh's share (HertzSpring). Owned by
/// NodeContact, whose nodes bear only beyond the depth that this contact takes up.
///
/// Depth over a triangle: sum of w_i d_i + sum of w_j w_k bulge_i, with the corners' depths d. Its
/// largest value is continuous from triangle to triangle, and its derivative by a corner's place is
/// the corner's weight there: the force has a potential.
class PoleContact {
public:
    static constexpr std::size_t kMostPoles = 8;
    /// Of the depth at which the mesh has become the spring. Deeper, the point stays where it is on
    /// the surface, or its dent would drive it about.
    static constexpr double kHold = 0.7;

    explicit PoleContact(const SurfaceNodes& surface) : surface_(surface) {}

    /// @param shape  borrowed till the next.
    /// @param share  of what a node bears, that is this contact's
    void begin_step(const RigidShape& shape, const ContactLaw& law, double share, double dt);
    void forget() noexcept { pole_count_ = 0; }
    void keep() noexcept { ///< as NodeContact's
        kept_ = pole_;
        kept_count_ = pole_count_;
    }
    void take_back() noexcept {
        pole_ = kept_;
        pole_count_ = kept_count_;
    }

    /// Chooses the nodes at which bulges come nearest among those near the shape: where all
    /// neighbours are farther, and as steep to the shape, in the rest frame, as the nearest of all,
    /// so that what contact has flattened stays one bulge.
    void look(std::span<const int> candidate, const NodeArray& position,
              const Pose& shape) noexcept;
    bool is_near() const noexcept { return pole_count_ > 0; }

    /// As SampleContact's.
    double find_touching(const NodeArray& position, const NodeArray& velocity,
                         const RigidShadow& rigid, double dt, unsigned long& tests) noexcept;
    bool is_touching() const noexcept { return touching_; }
    void sweep(const TouchForces& on, RigidResponse& rigid) noexcept;
    void enter_books(const TouchForces& on, const RigidResponse& rigid) noexcept;
    std::size_t drag(double softening, const TouchForces& on, RigidShadow& rigid) noexcept;
    /// As SampleContact's.
    template <class Use>
    void each_push(Use use) const {
        for (std::size_t p = 0; p < pole_count_; ++p)
            if (pole_[p].touches)
                use(pole_[p].touch.at.point, force_on_rigid(pole_[p].touch, pole_[p].state));
    }

private:
    struct Pole {
        int node = 0; ///< of the mesh: the deepest
        bool touches = false;
        TriangleTouch touch;
        TouchState state;
        Vec3 weight = Vec3::Zero(); ///< where it is on its triangle
        Vec3 trail = Vec3::Zero();  ///< where it was, lately, in the shape's frame [m]
        double force = 0;           ///< lately [N]
        bool held = false;          ///< where it is on the surface
        /// Elsewhere a pole has borne that the surface is in by here: its depth would be energy
        /// from nowhere. Till the surface has been out, its nodes bear.
        bool is_barred = false;
    };

    double depth_of(const NodeArray& position, const Pose& shape, int node) const noexcept;
    void climb(Pole& pole, const NodeArray& position, const Pose& shape) const noexcept;
    /// The deepest point of the curved surface round the pole's node.
    void find_deepest(Pole& pole, const NodeArray& position, const Pose& shape) const noexcept;

    /// The depth where the pole is.
    void follow(Pole& pole, const NodeArray& position, const Pose& shape) const noexcept;
    /// Two nodes as deep as each other share one pole between them.
    bool repeats_another(std::size_t pole) const noexcept;
    static void bar(Pole& pole) noexcept;
    /// Where the pressure's centre is: ahead of the deepest point, if this rolls on.
    void run_ahead(Pole& pole, const NodeArray& position, const Pose& shape,
                   double dt) const noexcept;
    void place(Pole& pole, const NodeArray& position) const noexcept;

    const SurfaceNodes& surface_;
    const RigidShape* shape_ = nullptr;
    ContactLaw law_;
    double share_ = 0;
    double dt_ = 0;
    std::array<Pole, kMostPoles> pole_, kept_;
    std::size_t pole_count_ = 0, kept_count_ = 0;
    bool touching_ = false;
};

} // namespace ode::soft
