#include "modal/dissect.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ode::soft {
namespace {

/// Below this a piece is eliminated as one dense block: its nodes are nearly all coupled anyway.
constexpr std::size_t kLeaf = 32;

/// Maximum matching and minimum vertex cover of the bipartite graph of cut edges.
class CutCover {
public:
    /// @param high   the value of `side` beyond the cut
    /// @param stamp  only ever raised, so that marks of earlier cuts mean nothing
    CutCover(const BlockSystem& system, const std::vector<int>& side, int high, int& stamp)
        : system_(system), side_(side), high_(high), stamp_(stamp) {}

    /// Nodes of `left` and their neighbours on the other side that cover all cut edges.
    std::vector<int> cover(const std::vector<int>& left, std::vector<int>& match,
                           std::vector<int>& mark) {
        for (const int i : left)
            if (match[at(i)] < 0)
                for_each_cut(i, [&](int j) {
                    if (match[at(i)] < 0 && match[at(j)] < 0) {
                        match[at(i)] = j;
                        match[at(j)] = i;
                    }
                });
        while (augment_all(left, match, mark)) {
        }
        // Koenig: what alternating paths from unmatched left nodes reach.
        for (const int i : left)
            if (match[at(i)] < 0)
                reach(i, match, mark);
        std::vector<int> out;
        for (const int i : left) {
            bool cut = false;
            for_each_cut(i, [&](int j) {
                cut = true;
                if (mark[at(j)] == stamp_) {
                    out.push_back(j);
                    mark[at(j)] = -1; // once
                }
            });
            if (cut && mark[at(i)] != stamp_)
                out.push_back(i);
        }
        for (const int i : left)
            for_each_cut(i, [&](int j) { match[at(i)] = match[at(j)] = -1; });
        return out;
    }

private:
    static std::size_t at(int i) { return static_cast<std::size_t>(i); }

    template <class Visit>
    void for_each_cut(int i, Visit visit) const {
        for (int p = system_.start[at(i)]; p < system_.start[at(i) + 1]; ++p)
            if (const int j = system_.column[at(p)]; side_[at(j)] == high_)
                visit(j);
    }

    /// Depth-first augmenting paths, one pass over the unmatched nodes; true if any was found.
    bool augment_all(const std::vector<int>& left, std::vector<int>& match,
                     std::vector<int>& mark) {
        ++stamp_;
        bool found = false;
        for (const int i : left)
            if (match[at(i)] < 0)
                found = augment(i, match, mark) || found;
        if (!found)
            ++stamp_;
        return found;
    }

    bool augment(int root, std::vector<int>& match, std::vector<int>& mark) {
        struct Frame {
            int node, pair;
        };
        std::vector<Frame> path{{root, system_.start[at(root)]}};
        std::vector<int> via; // right node between path[k] and path[k+1]
        while (!path.empty()) {
            Frame& top = path.back();
            bool deeper = false;
            while (top.pair < system_.start[at(top.node) + 1]) {
                const int j = system_.column[at(top.pair++)];
                if (side_[at(j)] != high_ || mark[at(j)] == stamp_)
                    continue;
                mark[at(j)] = stamp_;
                via.push_back(j);
                if (match[at(j)] < 0) {
                    for (std::size_t k = via.size(); k-- > 0;) {
                        match[at(via[k])] = path[k].node;
                        match[at(path[k].node)] = via[k];
                    }
                    return true;
                }
                const int next = match[at(j)];
                path.push_back({next, system_.start[at(next)]});
                deeper = true;
                break;
            }
            if (!deeper) {
                path.pop_back();
                if (!via.empty())
                    via.pop_back();
            }
        }
        return false;
    }

    void reach(int root, const std::vector<int>& match, std::vector<int>& mark) {
        std::vector<int> stack{root};
        mark[at(root)] = stamp_;
        while (!stack.empty()) {
            const int i = stack.back();
            stack.pop_back();
            for_each_cut(i, [&](int j) {
                if (mark[at(j)] == stamp_)
                    return;
                mark[at(j)] = stamp_;
                const int back = match[at(j)]; // a maximum matching leaves no free node here
                if (back >= 0 && mark[at(back)] != stamp_) {
                    mark[at(back)] = stamp_;
                    stack.push_back(back);
                }
            });
        }
    }

    const BlockSystem& system_;
    const std::vector<int>& side_;
    int high_;
    int& stamp_;
};

class Dissector {
public:
    explicit Dissector(const BlockSystem& system)
        : system_(system), side_(system.node_count(), -1), match_(system.node_count(), -1),
          mark_(system.node_count(), -1) {}

    int run(std::vector<int> nodes) {
        if (nodes.size() <= kLeaf)
            return emit(nodes, {});
        Cut best = choose_cut(nodes);
        if (best.low.empty() || best.high.empty()) // one clump: no plane separates it
            return emit(nodes, {});
        nodes.clear();
        nodes.shrink_to_fit();
        const int a = run(std::move(best.low));
        const int b = run(std::move(best.high));
        return emit(best.separator, {a, b});
    }

    Dissection result;

private:
    struct Cut {
        std::vector<int> low, high, separator;
    };

    int emit(const std::vector<int>& nodes, std::initializer_list<int> children) {
        const int first = static_cast<int>(result.order.size());
        result.order.insert(result.order.end(), nodes.begin(), nodes.end());
        result.piece.push_back({first, static_cast<int>(result.order.size()), -1});
        const int self = static_cast<int>(result.piece.size()) - 1;
        for (const int child : children)
            result.piece[static_cast<std::size_t>(child)].parent = self;
        return self;
    }

    Cut choose_cut(const std::vector<int>& nodes) {
        Vec3 mean = Vec3::Zero();
        for (const int i : nodes)
            mean += system_.position[static_cast<std::size_t>(i)];
        mean /= static_cast<double>(nodes.size());
        Mat3 spread = Mat3::Zero();
        for (const int i : nodes) {
            const Vec3 d = system_.position[static_cast<std::size_t>(i)] - mean;
            spread += d * d.transpose();
        }
        const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread);
        Cut best;
        for (int axis = 2; axis >= 0; --axis) { // longest first
            // A cut across an axis of less than half the length has about twice the area.
            if (axis < 2 && axes.eigenvalues()[axis] < 0.25 * axes.eigenvalues()[2])
                break;
            Cut cut = cut_across(nodes, axes.eigenvectors(), axis);
            if (axis == 2 || cut.separator.size() < best.separator.size())
                best = std::move(cut);
        }
        return best;
    }

    Cut cut_across(const std::vector<int>& nodes, const Mat3& axes, int axis) {
        struct Place {
            double along, across, third;
            int node;
        };
        std::vector<Place> place;
        place.reserve(nodes.size());
        for (const int i : nodes) {
            const Vec3 x = axes.transpose() * system_.position[static_cast<std::size_t>(i)];
            // Rounded, so that nodes of one lattice plane tie and the later keys order them.
            place.push_back({x[axis], x[(axis + 2) % 3], x[(axis + 1) % 3], i});
        }
        const auto [least, most] =
            std::minmax_element(place.begin(), place.end(),
                                [](const Place& a, const Place& b) { return a.along < b.along; });
        const double grain = 1e-6 * (most->along - least->along) + 1e-300;
        for (Place& p : place) {
            p.along = std::round(p.along / grain);
            p.across = std::round(p.across / grain);
            p.third = std::round(p.third / grain);
        }
        std::sort(place.begin(), place.end(), [](const Place& a, const Place& b) {
            return std::tie(a.along, a.across, a.third, a.node) <
                   std::tie(b.along, b.across, b.third, b.node);
        });
        const int low = 2 * ++cuts_, high = low + 1;
        const std::size_t half = place.size() / 2;
        std::vector<int> left;
        for (std::size_t k = 0; k < place.size(); ++k) {
            side_[static_cast<std::size_t>(place[k].node)] = k < half ? low : high;
            if (k < half)
                left.push_back(place[k].node);
        }
        Cut cut;
        cut.separator = CutCover(system_, side_, high, stamp_).cover(left, match_, mark_);
        for (const int i : cut.separator)
            side_[static_cast<std::size_t>(i)] = -1;
        for (const Place& p : place)
            if (const int s = side_[static_cast<std::size_t>(p.node)]; s == low)
                cut.low.push_back(p.node);
            else if (s == high)
                cut.high.push_back(p.node);
        for (const int i : nodes)
            side_[static_cast<std::size_t>(i)] = -1;
        return cut;
    }

    const BlockSystem& system_;
    std::vector<int> side_, match_, mark_;
    int cuts_ = 0, stamp_ = 0;
};

} // namespace

Dissection dissect(const BlockSystem& system) {
    Dissector dissector(system);
    std::vector<int> all(system.node_count());
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = static_cast<int>(i);
    dissector.run(std::move(all));
    return std::move(dissector.result);
}

} // namespace ode::soft
