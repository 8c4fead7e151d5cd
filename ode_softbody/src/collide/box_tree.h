#pragma once

#include "collide/aabb.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace ode::soft {

/// Binary tree of boxes over a body's surface elements. Which element lies in which box is settled
/// once, from the shape at rest; refit() brings the boxes up to date, because elements that were
/// neighbours stay neighbours however a body deforms.
class BoxTree {
public:
    BoxTree() = default;
    /// Splits at the median along the longest side. @param box  of each element at rest.
    explicit BoxTree(std::span<const Aabb> box);

    /// @param box_of  box_of(element) is its box now.
    template <class BoxOf>
    void refit(BoxOf&& box_of) noexcept {
        for (std::size_t i = node_.size(); i-- > 0;) {
            Node& node = node_[i];
            if (node.count == 0) { // the children come later in the array
                node.box = node_[i + 1].box;
                node.box.include(node_[static_cast<std::size_t>(node_[i + 1].next)].box);
                continue;
            }
            node.box = Aabb::empty();
            for (int k = node.first; k < node.first + node.count; ++k)
                node.box.include(box_of(element_[static_cast<std::size_t>(k)]));
        }
    }

    Aabb bounds() const noexcept { return node_.empty() ? Aabb::empty() : node_.front().box; }

    /// Calls visit(element) for every element whose leaf's box comes within `reach` of `box` [m];
    /// give a point as a box without extent.
    /// @return a lower bound of the distance to all elements not visited [m].
    template <class Visit>
    double near(const Aabb& box, double reach, Visit&& visit) const {
        double nearest2 = std::numeric_limits<double>::infinity();
        const double reach2 = reach * reach;
        for (std::size_t i = 0; i < node_.size();) {
            const Node& node = node_[i];
            const double distance2 = box.distance2(node.box);
            if (!(distance2 < reach2)) {
                nearest2 = std::fmin(nearest2, distance2);
                i = static_cast<std::size_t>(node.next);
                continue;
            }
            for (int k = node.first; k < node.first + node.count; ++k)
                visit(element_[static_cast<std::size_t>(k)]);
            ++i;
        }
        return std::sqrt(nearest2);
    }

private:
    struct Node { ///< in order of a depth-first walk
        Aabb box;
        int first; ///< of a leaf, into element_
        int count; ///< 0: two children, the first right behind
        int next;  ///< node behind the whole branch
    };
    void grow(std::span<const Aabb> box, int first, int count);

    std::vector<Node> node_;
    std::vector<int> element_;
};

} // namespace ode::soft
