#include "mesh/octahedron.h"

#include "mesh/quality.h"

#include <algorithm>

namespace ode::soft {

namespace {

using Pairs = std::array<std::array<int, 2>, 3>;
using Quarters = std::array<std::array<int, 4>, 4>;

Quarters quarter(const Pairs& opposite, std::size_t axis) {
    const auto& [top, bottom] = opposite[axis];
    const auto& u = opposite[(axis + 1) % 3];
    const auto& v = opposite[(axis + 2) % 3];
    const std::array<int, 4> belt = {u[0], v[0], u[1], v[1]}; // counter-clockwise seen from top
    Quarters out;
    for (std::size_t i = 0; i < 4; ++i)
        out[i] = {bottom, belt[i], belt[(i + 1) % 4], top};
    return out;
}

double worst_quality(const std::vector<Vec3>& node, const Quarters& quarters) {
    double worst = 1.0;
    for (const auto& q : quarters) {
        const auto x = [&](std::size_t i) { return node[static_cast<std::size_t>(q[i])]; };
        worst = std::min(worst, tetrahedron_quality(x(0), x(1), x(2), x(3)));
    }
    return worst;
}

} // namespace

void cut_octahedron(const std::vector<Vec3>& node, const Pairs& opposite,
                    std::vector<int>& element) {
    // Rounding must not choose between diagonals and qualities that symmetry makes equal.
    constexpr double kSame = 1e-9;
    std::array<double, 3> squared_length;
    for (std::size_t k = 0; k < 3; ++k)
        squared_length[k] = (node[static_cast<std::size_t>(opposite[k][0])] -
                             node[static_cast<std::size_t>(opposite[k][1])])
                                .squaredNorm();
    const double shortest = *std::min_element(squared_length.begin(), squared_length.end());
    std::size_t best = 3;
    double best_quality = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        if (squared_length[k] > shortest * (1.0 + kSame))
            continue;
        const double quality = worst_quality(node, quarter(opposite, k));
        if (best == 3 || quality > best_quality + kSame) {
            best = k;
            best_quality = quality;
        }
    }
    for (const auto& q : quarter(opposite, best))
        element.insert(element.end(), q.begin(), q.end());
}

} // namespace ode::soft
