#include "collide/box_tree.h"

#include <algorithm>
#include <numeric>

namespace ode::soft {
namespace {
constexpr int kLeaf = 2; ///< elements in a leaf at most
}

BoxTree::BoxTree(std::span<const Aabb> box) : element_(box.size()) {
    std::iota(element_.begin(), element_.end(), 0);
    node_.reserve(2 * box.size());
    if (!box.empty())
        grow(box, 0, static_cast<int>(box.size()));
}

void BoxTree::grow(std::span<const Aabb> box, int first, int count) {
    const std::size_t here = node_.size();
    node_.push_back({Aabb::empty(), first, count, 0});
    for (int k = first; k < first + count; ++k)
        node_[here].box.include(
            box[static_cast<std::size_t>(element_[static_cast<std::size_t>(k)])]);
    if (count > kLeaf) {
        Vec3::Index axis = 0;
        (node_[here].box.high - node_[here].box.low).maxCoeff(&axis);
        const auto middle = [&](int e) {
            const Aabb& b = box[static_cast<std::size_t>(e)];
            return b.low[axis] + b.high[axis];
        };
        const auto begin = element_.begin() + first;
        std::nth_element(begin, begin + count / 2, begin + count, [&](int a, int b) {
            return middle(a) != middle(b) ? middle(a) < middle(b) : a < b;
        });
        node_[here].count = 0;
        grow(box, first, count / 2);
        grow(box, first + count / 2, count - count / 2);
    }
    node_[here].next = static_cast<int>(node_.size());
}

} // namespace ode::soft
