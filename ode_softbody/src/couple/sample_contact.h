#pragma once

#include "collide/aabb.h"
#include "couple/rigid_samples.h"
#include "couple/triangle_touch.h"

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

    /// Fills touch_. @return what their friction asks of the rigid body's stability; tests are
    /// added up.
    double find_touching(const NodeArray& position, const NodeArray& velocity,
                         const RigidShadow& rigid, const Pose& in_body, double dt,
                         unsigned long& tests) noexcept;
    /// Normal forces of the contacts found, see sweep_triangle().
    void sweep(const TouchForces& on, RigidResponse& rigid) noexcept;
    /// Their friction. @return how many bear.
    std::size_t drag(double softening, const TouchForces& on, RigidShadow& rigid) noexcept;
    void enter_books(const TouchForces& on, const RigidResponse& rigid) noexcept;

    /// use(point [m], force [N]): what the rigid body gets of each touch, once all is known.
    template <class Use>
    void each_push(Use use) const {
        for (const Touch& touch : touch_)
            use(touch.at.point,
                force_on_rigid(touch, state_[static_cast<std::size_t>(touch.sample)]));
    }

    bool is_touching() const noexcept { return !touch_.empty(); }
    double reach() const noexcept; ///< of the farthest sample from the shape's origin [m]
    bool exist() const noexcept { return !sample_.empty(); }
    bool is_near() const noexcept { return !near_.empty(); }
    void collect_nodes(std::vector<int>& out) const; ///< as NodeContact's
    void forget() noexcept;
    void keep() { kept_ = state_; } ///< as NodeContact's
    void take_back() noexcept { state_.swap(kept_); }

private:
    struct State : TouchState {
        bool was_outside = false;
    };
    struct Near { ///< a sample and its range of pair_
        int sample;
        int first;
        int last;
    };
    struct Touch : TriangleTouch {
        int sample;
    };
    struct Closest {
        int triangle = -1;
        TrianglePoint at;
        double distance2;
    };

    Closest find_closest(const Near& near, const Vec3& center, const State& state,
                         const NodeArray& position) const noexcept;

    const SurfaceNodes& surface_;
    RigidShape shape_;
    ContactLaw law_;
    double dt_ = 0;
    double spacing_ = 0; ///< [m]
    std::vector<RigidSample> sample_;
    std::vector<State> state_, kept_;
    std::vector<Near> near_;
    std::vector<int> pair_; ///< triangles
    struct Close {
        int triangle;
        Aabb box;
    };
    std::vector<Close> close_; ///< near some sample; scratch of look()
    std::vector<Touch> touch_;
};

} // namespace ode::soft
