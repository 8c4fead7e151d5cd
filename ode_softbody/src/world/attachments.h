#pragma once

#include "collide/body_watch.h"
#include "couple/rigid_bond.h"

#include <memory>
#include <span>
#include <vector>

namespace ode::soft {

class Body;
class RigidExchange;

/// Nodes of soft bodies that are nailed to rigid ones: they keep their place in the rigid body's
/// frame, which feels their inertia and their forces (RigidBond). One bond a rigid body, whatever
/// is nailed to it. A soft body doesn't collide with what it is nailed to, as ODE's jointed bodies
/// usually don't.
class Attachments {
public:
    /// Nails nodes where they are now. Held nodes and those nailed elsewhere are left out.
    /// @return how many nodes of this soft body are nailed to this rigid one.
    int attach(Body& soft, dBodyID rigid, std::span<const int> nodes);
    /// @return how many nodes became free.
    int detach(Body& soft, dBodyID rigid) noexcept;
    void forget(const Body& soft) noexcept; ///< it ends
    bool has(const Body& soft) const noexcept;
    bool has(const Body& soft, dBodyID rigid) const noexcept;

    /// Lets go of rigid bodies that have ended, after a sentence.
    void check() noexcept;
    /// Tells which rigid bodies take part in the step to come.
    void announce(RigidExchange& exchange) const;
    /// Puts the nodes where they belong, wherever the application has moved their rigid body.
    void begin_step(RigidExchange& exchange, double h, double dt) noexcept;
    /// Once all other forces of the substep are known, before anything moves.
    void bind(RigidExchange& exchange, double dt) noexcept;
    /// After everything has moved.
    void follow(const RigidExchange& exchange) noexcept;

private:
    struct Nail {
        int node;
        Vec3 place; ///< in the rigid body's frame [m]
    };
    struct Group { ///< the nodes of one soft body
        Body* soft;
        std::vector<Nail> nail;
    };
    struct Anchor { ///< one rigid body
        dBodyID rigid;
        std::unique_ptr<BodyWatch> watch;
        std::vector<Group> group;
        RigidBond bond;
        std::size_t shadow = 0; ///< in this step
    };

    Anchor* find(dBodyID rigid) noexcept;
    const Group* find(const Body& soft, dBodyID rigid) const noexcept;

    std::vector<Anchor> anchor_;
};

} // namespace ode::soft
