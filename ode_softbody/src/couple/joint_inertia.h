#pragma once

#include "base/types.h"

#include <array>

namespace ode::soft {

/// A point of a surface, as the nodes that carry it.
struct CarriedPoint {
    std::array<int, 3> node; ///< of the mesh
    Vec3 weight;             ///< zero: the node has no part in it
};

/// Nodes that no mass is the own of: a push at one moves others within the same substep. Contact
/// asks it instead of nodal masses, where there is one.
class JointInertia {
public:
    virtual ~JointInertia() = default;

    /// Mean velocity over the substep to come, with all pushes so far [m/s].
    virtual Vec3 ahead(const CarriedPoint& point) const noexcept = 0;
    /// What an impulse of 1 N s, spread over the substep, along a unit vector adds to it [1/kg].
    virtual double compliance(const CarriedPoint& point, const Vec3& direction) const noexcept = 0;
    /// What the same impulse at a node adds to the node's own velocity [1/kg].
    virtual Vec3 yield(std::size_t node, const Vec3& direction) const noexcept = 0;
    /// A constant force over the substep [N].
    virtual void push(std::size_t node, const Vec3& force) noexcept = 0;
};

} // namespace ode::soft
