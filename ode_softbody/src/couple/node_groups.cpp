#include "couple/node_groups.h"

#include "collide/aabb.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ode::soft {
namespace {

constexpr int kMostNodes = 16; // a look at a group costs about as much as at a node

} // namespace

NodeGroups::NodeGroups(std::span<const int> node, std::span<const Vec3> rest)
    : order_(node.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    if (!node.empty())
        split(0, static_cast<int>(node.size()), node, rest);
}

void NodeGroups::split(int first, int end, std::span<const int> node, std::span<const Vec3> rest) {
    const auto place = [&](int i) -> const Vec3& {
        return rest[static_cast<std::size_t>(node[static_cast<std::size_t>(i)])];
    };
    const auto from = order_.begin() + first;
    const auto to = order_.begin() + end;
    Aabb box = Aabb::empty();
    std::for_each(from, to, [&](int i) { box.include(place(i)); });
    if (end - first <= kMostNodes) {
        const Vec3 center = (box.low + box.high) / 2;
        double radius2 = 0;
        std::for_each(from, to, [&](int i) {
            radius2 = std::fmax(radius2, (place(i) - center).squaredNorm());
        });
        group_.push_back({center, std::sqrt(radius2), first, end});
        return;
    }
    int axis = 0;
    (box.high - box.low).maxCoeff(&axis);
    const int middle = (first + end) / 2;
    std::nth_element(from, order_.begin() + middle, to, [&](int a, int b) {
        const double there = place(a)[axis], here = place(b)[axis];
        return there < here || (there == here && a < b);
    });
    split(first, middle, node, rest);
    split(middle, end, node, rest);
}

} // namespace ode::soft
