#include "transfer/coarsen.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <queue>
#include <tuple>

namespace ode::sound {
namespace {

using Plane = Eigen::Vector4d;
using Quadric = Eigen::Matrix4d;

class Collapser {
public:
    explicit Collapser(const BoundaryMesh& mesh)
        : node_(mesh.node), triangle_(mesh.triangle), alive_(mesh.triangle.size(), 1),
          around_(mesh.node.size()), quadric_(mesh.node.size(), Quadric::Zero()),
          version_(mesh.node.size(), 0), left_(mesh.triangle.size()) {
        const std::vector<Facet> facets = mesh.facets();
        for (std::size_t t = 0; t < triangle_.size(); ++t) {
            Plane p;
            p << facets[t].normal, -facets[t].normal.dot(facets[t].corner[0]);
            for (const int i : triangle_[t]) {
                around_[at(i)].push_back(static_cast<int>(t));
                quadric_[at(i)] += facets[t].area * p * p.transpose();
            }
        }
        for (std::size_t i = 0; i < node_.size(); ++i)
            offer(static_cast<int>(i));
    }

    void run(std::size_t triangles) {
        while (left_ > triangles && !queue_.empty()) {
            const Edge e = queue_.top();
            queue_.pop();
            if (e.from_version == version_[at(e.from)] && e.to_version == version_[at(e.to)] &&
                may_go(e.from, e.to))
                collapse(e.from, e.to);
        }
    }

    Coarsened result() const {
        Coarsened out;
        std::vector<int> number(node_.size(), -1);
        for (std::size_t t = 0; t < triangle_.size(); ++t) {
            if (!alive_[t])
                continue;
            std::array<int, 3> corners{};
            for (std::size_t k = 0; k < 3; ++k) {
                int& n = number[at(triangle_[t][k])];
                if (n < 0) {
                    n = static_cast<int>(out.kept.size());
                    out.kept.push_back(triangle_[t][k]);
                    out.mesh.node.push_back(node_[at(triangle_[t][k])]);
                }
                corners[k] = n;
            }
            out.mesh.triangle.push_back(corners);
        }
        return out;
    }

private:
    struct Edge {
        double cost;
        int from, to;
        int from_version, to_version;
        bool operator>(const Edge& o) const {
            return std::tie(cost, from, to) > std::tie(o.cost, o.from, o.to);
        }
    };
    static std::size_t at(int i) { return static_cast<std::size_t>(i); }

    std::vector<int> neighbours(int i) const {
        std::vector<int> out;
        for (const int t : around_[at(i)])
            for (const int n : triangle_[at(t)])
                if (n != i)
                    out.push_back(n);
        std::sort(out.begin(), out.end());
        out.erase(std::unique(out.begin(), out.end()), out.end());
        return out;
    }

    void offer(int from) {
        for (const int to : neighbours(from)) {
            const Vec3& x = node_[at(to)];
            const Plane p(x[0], x[1], x[2], 1.0);
            const Quadric q = quadric_[at(from)] + quadric_[at(to)];
            // In a plane every collapse is free: shorter edges first, to keep triangles even.
            const double length = (node_[at(from)] - x).squaredNorm();
            queue_.push({std::max(p.dot(q * p), 0.0) + 1e-6 * length * length, from, to,
                         version_[at(from)], version_[at(to)]});
        }
    }

    bool may_go(int from, int to) const {
        const std::vector<int> a = neighbours(from), b = neighbours(to);
        std::vector<int> both;
        std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
        if (both.size() != 2 || a.size() + b.size() < 8) // else walls grow together
            return false;
        for (const int t : around_[at(from)]) {
            std::array<int, 3> c = triangle_[at(t)];
            if (std::find(c.begin(), c.end(), to) != c.end())
                continue;
            const Facet old(node_[at(c[0])], node_[at(c[1])], node_[at(c[2])]);
            std::replace(c.begin(), c.end(), from, to);
            const Facet fresh(node_[at(c[0])], node_[at(c[1])], node_[at(c[2])]);
            constexpr double kTurn = 0.3;  // cosine
            constexpr double kThin = 0.01; // area over the square of the size; even: 0.43
            if (fresh.normal.dot(old.normal) < kTurn ||
                fresh.area < kThin * fresh.size() * fresh.size())
                return false;
        }
        return true;
    }

    void collapse(int from, int to) {
        for (const int t : around_[at(from)]) {
            auto& c = triangle_[at(t)];
            if (std::find(c.begin(), c.end(), to) != c.end()) {
                alive_[at(t)] = 0;
                --left_;
                for (const int n : c)
                    if (n != from)
                        std::erase(around_[at(n)], t);
            } else {
                std::replace(c.begin(), c.end(), from, to);
                around_[at(to)].push_back(t);
            }
        }
        around_[at(from)].clear();
        quadric_[at(to)] += quadric_[at(from)];
        ++version_[at(from)];
        ++version_[at(to)];
        offer(to);
        for (const int n : neighbours(to)) {
            ++version_[at(n)];
            offer(n);
        }
    }

    std::vector<Vec3> node_;
    std::vector<std::array<int, 3>> triangle_;
    std::vector<char> alive_;
    std::vector<std::vector<int>> around_; ///< triangles of a node
    std::vector<Quadric> quadric_;
    std::vector<int> version_; ///< an offer older than its ends is void
    std::size_t left_;
    std::priority_queue<Edge, std::vector<Edge>, std::greater<>> queue_;
};

} // namespace

Coarsened coarsen(const BoundaryMesh& mesh, std::size_t triangles) {
    Collapser collapser(mesh);
    collapser.run(triangles);
    return collapser.result();
}

BoundaryMesh split(const BoundaryMesh& mesh, std::vector<std::array<int, 2>>& parents) {
    BoundaryMesh out;
    out.node = mesh.node;
    parents.clear();
    std::map<std::array<int, 2>, int> middle;
    const auto between = [&](int a, int b) {
        const std::array<int, 2> edge = {std::min(a, b), std::max(a, b)};
        const auto [found, fresh] = middle.try_emplace(edge, static_cast<int>(out.node.size()));
        if (fresh) {
            parents.push_back(edge);
            out.node.push_back(0.5 * (mesh.node[static_cast<std::size_t>(a)] +
                                      mesh.node[static_cast<std::size_t>(b)]));
        }
        return found->second;
    };
    for (const auto& [a, b, c] : mesh.triangle) {
        const int ab = between(a, b), bc = between(b, c), ca = between(c, a);
        for (const std::array<int, 3>& t : {std::array{a, ab, ca}, std::array{b, bc, ab},
                                            std::array{c, ca, bc}, std::array{ab, bc, ca}})
            out.triangle.push_back(t);
    }
    return out;
}

bool is_closed(const BoundaryMesh& mesh) {
    std::map<std::array<int, 2>, int> seen; // one way less the other
    for (const auto& t : mesh.triangle)
        for (std::size_t k = 0; k < 3; ++k)
            if (++seen[{t[k], t[(k + 1) % 3]}] > 1)
                return false;
    return std::all_of(seen.begin(), seen.end(), [&](const auto& edge) {
        return seen.count({edge.first[1], edge.first[0]}) == 1;
    });
}

} // namespace ode::sound
