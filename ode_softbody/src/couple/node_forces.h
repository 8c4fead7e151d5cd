#pragma once

#include "couple/joint_inertia.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace ode::soft {

/// What contacts give to the nodes of one body in a substep, besides being part of all its force:
/// so that their work can be told, at the cost of the nodes they push.
class ContactShare {
public:
    ContactShare() = default;
    explicit ContactShare(std::size_t nodes) : force_(nodes), is_pushed_(nodes, 0) {
        pushed_.reserve(nodes);
    }

    void add(std::size_t node, const Vec3& force) noexcept {
        if (!is_pushed_[node]) {
            is_pushed_[node] = 1;
            pushed_.push_back(node);
        }
        force_[node] += force;
    }

    /// visit(node, force [N]) for each node pushed.
    template <class Visit>
    void each(Visit visit) const {
        for (const std::size_t node : pushed_)
            visit(node, force_[node]);
    }
    void clear() noexcept {
        for (const std::size_t node : pushed_) {
            force_[node].setZero();
            is_pushed_[node] = 0;
        }
        pushed_.clear();
    }
    bool empty() const noexcept { return pushed_.empty(); }

private:
    NodeArray force_; ///< zero but at pushed_ [N]
    std::vector<std::uint8_t> is_pushed_;
    std::vector<std::size_t> pushed_;
};

/// All force on a body's nodes [N], to read and for contacts to add to. Borrowed for a call.
class NodeForces {
public:
    /// @param share  keeps book of what is added here, unless null.
    /// @param joint  is told of it, unless null.
    NodeForces(NodeArray& all, ContactShare* share = nullptr,
               JointInertia* joint = nullptr) noexcept
        : all_(&all), share_(share), joint_(joint) {}

    Eigen::Map<const Vec3> operator[](std::size_t node) const noexcept {
        return std::as_const(*all_)[node];
    }
    void add(std::size_t node, const Vec3& force) const noexcept {
        (*all_)[node] += force;
        if (share_)
            share_->add(node, force);
        if (joint_)
            joint_->push(node, force);
    }
    const JointInertia* joint() const noexcept { return joint_; }

private:
    NodeArray* all_;
    ContactShare* share_;
    JointInertia* joint_;
};

} // namespace ode::soft
