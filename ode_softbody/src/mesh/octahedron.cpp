#include "mesh/octahedron.h"

namespace ode::soft {

void cut_octahedron(const std::vector<Vec3>& node,
                    const std::array<std::array<int, 2>, 3>& opposite, std::vector<int>& element) {
    const auto squared_length = [&](const std::array<int, 2>& d) {
        return (node[static_cast<std::size_t>(d[0])] - node[static_cast<std::size_t>(d[1])])
            .squaredNorm();
    };
    // A rounding error must not choose between diagonals that symmetry makes equal.
    constexpr double kShorter = 1.0 - 1e-9;
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (squared_length(opposite[k]) < kShorter * squared_length(opposite[axis]))
            axis = k;
    const auto& [top, bottom] = opposite[axis];
    const auto& u = opposite[(axis + 1) % 3];
    const auto& v = opposite[(axis + 2) % 3];
    const std::array<int, 4> belt = {u[0], v[0], u[1], v[1]}; // counter-clockwise seen from top
    for (std::size_t i = 0; i < 4; ++i)
        element.insert(element.end(), {bottom, belt[i], belt[(i + 1) % 4], top});
}

} // namespace ode::soft
