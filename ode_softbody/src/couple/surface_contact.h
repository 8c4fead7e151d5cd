#pragma once

#include "collide/closest_point.h"
#include "couple/pair_law.h"
#include "couple/soft_surface.h"

#include <limits>
#include <span>
#include <vector>

namespace ode::soft {

/// Contact of one soft surface's points with another's triangles, or with the rest of its own.
///
/// A point bears where it lies inside: its depth is the distance to the surface point closest to
/// it, which is continuous as it moves over faces, edges and vertices, so that the force, along
/// that distance, has a potential: k depth^2 / 2, by its discrete gradient (conserving_press).
/// Inside and outside are told apart by the closest feature's pseudonormal.
///
/// Springs share nodes, and each must know the others' force to keep energy: sweep() goes over them
/// until they agree (Gauss-Seidel; two sweeps do). Where a point passes from one face's realm to
/// another's within a substep, the force turns and the potential isn't followed exactly; so each
/// spring keeps book of the energy it has taken and never gives back more.
///
/// A point that was seen outside before may be at any depth; one first seen inside counts only down
/// to a quarter of an edge. Once it bears, only triangles that face as then, within 90 degrees, are
/// the surface: the far side of a thin body doesn't pull it through, even after it has passed the
/// whole thickness in one substep. A point all but on a side, as where two boxes lie flush, is
/// pushed back and not out sideways; it is let go where it has slipped off beside.
///
/// Linear and angular momentum are kept to rounding: normal forces act along the line between the
/// two points, friction at one of them, see drag().
class SurfaceContact {
public:
    /// @param self  points and faces are of one body: triangles that lie within an edge of the
    ///              point at rest are not looked at.
    SurfaceContact(const SoftSurface& points, const SoftSurface& faces, bool self);

    void begin_step(const PairLaw& law) noexcept { law_ = law; }
    void keep() { ///< as NodeContact's
        kept_state_ = state_;
        kept_touch_ = touch_;
    }
    void take_back() noexcept {
        state_.swap(kept_state_);
        touch_.swap(kept_touch_);
    }

    /// Lists the points that may touch, and the triangles that may be closest to them, for as long
    /// as no point moves more than `slack` [m] against the faces. The faces' tree must fit.
    /// @param reach  points farther from the surface are left out [m], >= slack.
    /// @return a lower bound of the distance of those left out [m].
    double look(const SoftSide& points, const SoftSide& faces, double reach, double slack,
                unsigned long& tests);

    /// Books what the springs of the last substep have done. @param dt  of that substep.
    void settle(const SoftSide& points, const SoftSide& faces, double dt) noexcept;

    /// Everything is out of reach.
    void look_away() noexcept;

    /// Finds the points that are in, or may be at the end of the substep.
    /// @param way  that points have moved against the faces at most since the last look [m].
    void find_touching(const SoftSide& points, const SoftSide& faces, double way, double dt,
                       unsigned long& tests) noexcept;

    /// Speeds and masses of what find_touching() found.
    void prepare(const SoftSide& points, const SoftSide& faces) noexcept;

    /// Brings each point's normal force in line with all other force on its nodes, in turn.
    /// @return the largest change [N].
    double sweep(const SoftSide& points, const SoftSide& faces, double dt) noexcept;

    /// Adds friction to the normal forces. @return points that bear force.
    std::size_t drag(const SoftSide& points, const SoftSide& faces, double dt) noexcept;

    bool is_near() const noexcept { return !near_.empty(); }

private:
    struct State {
        bool bears = false;
        bool was_outside = false;
        Vec3 normal = Vec3::Zero();  ///< of the faces, outward, world
        Vec3 stretch = Vec3::Zero(); ///< of the friction spring, world [m]
        double stiffness = 0;        ///< never rises while it bears [N/m]
        double grip = 0;             ///< stiffness that friction may have [N/m]
        double depth = 0;            ///< lately [m]
        double paid = 0;             ///< energy that the spring has taken and not given back [J]
    };
    struct Near { ///< a point and its range of face_
        int point;
        int first;
        int last;
        double wake; ///< way until which it can't touch [m]
    };
    struct Touch {
        int point;
        int triangle;
        TrianglePoint at;
        double depth;
        double press;      ///< so far [N]
        double spring;     ///< its conserving part [N]
        double damping;    ///< [N s/m]
        double compliance; ///< [1/kg]
        Vec3 slip;         ///< of the point against the face, half a substep ago [m/s]
        Vec3 normal;       ///< outward [-]
    };
    struct Closest {
        int triangle = -1;
        TrianglePoint at;
        double distance2 = std::numeric_limits<double>::infinity();
    };
    struct Found {
        int triangle;
        double distance;
    };

    /// Normal force of one contact. @param parting  speed half a substep ago. @param ahead  in half
    /// a substep, if it weren't for this contact [m/s]; fills touch.spring.
    static double press_of(Touch& touch, const State& state, double parting, double ahead,
                           double dt) noexcept;
    void apply(const Touch& touch, const Vec3& f, const SoftSide& points,
               const SoftSide& faces) const noexcept;
    bool are_neighbours(int point, int triangle) const noexcept;
    double cosine_with(const Vec3& normal, int triangle, const NodeArray& position) const noexcept;
    /// Of all listed faces; of those that don't face against the way the point came in; of those
    /// that face along it.
    void find_closest(const Near& near, const Vec3& x, const State& state,
                      const NodeArray& position, Closest& any, Closest& facing,
                      Closest& front) const noexcept;
    bool flush_with(const Closest& facing, const Closest& front) const noexcept;
    /// A bearing point has left the body beside the face that it came in through.
    bool has_slipped_off(const Closest& closest, const Vec3& x, const State& state,
                         const NodeArray& position) const noexcept;

    const SoftSurface& points_;
    const SoftSurface& faces_;
    bool self_;
    PairLaw law_;
    std::vector<State> state_, kept_state_; ///< per point
    std::vector<Near> near_;
    std::vector<int> face_; ///< triangles
    std::vector<Touch> touch_, kept_touch_;
    std::vector<Found> found_; ///< scratch of look()
};

} // namespace ode::soft
