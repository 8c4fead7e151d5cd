#pragma once

#include "base/types.h"

#include <span>
#include <vector>

namespace ode::soft {

/// Nodes that lie together at rest, so that many can be seen to be far from a shape by one look.
class NodeGroups {
public:
    struct Group {
        Vec3 center;    ///< body frame [m]
        double radius;  ///< of a ball that holds its nodes [m]
        int first, end; ///< its part of order()
    };

    NodeGroups() = default;
    /// @param node  which.  @param rest  of every mesh node, body frame [m].
    NodeGroups(std::span<const int> node, std::span<const Vec3> rest);

    std::span<const Group> groups() const noexcept { return group_; }
    /// Indices into the nodes given.
    std::span<const int> members(const Group& group) const noexcept {
        return std::span(order_).subspan(static_cast<std::size_t>(group.first),
                                         static_cast<std::size_t>(group.end - group.first));
    }

private:
    void split(int first, int end, std::span<const int> node, std::span<const Vec3> rest);

    std::vector<int> order_;
    std::vector<Group> group_;
};

} // namespace ode::soft
