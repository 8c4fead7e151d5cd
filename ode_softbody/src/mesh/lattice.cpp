#include "mesh/lattice.h"

#include "base/error.h"
#include "mesh/generate.h"

#include <cmath>
#include <utility>

namespace ode::soft {

namespace {

// The six monotone paths from corner (0,0,0) of a cell to (1,1,1), as orders of the axes: Kuhn's
// subdivision. Odd permutations give inverted elements.
constexpr int kPath[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};

} // namespace

void require_length(double value, const char* what, const char* shape) {
    if (!(std::isfinite(value) && value > 0.0))
        throw InputError(format("%s: %s is %g m: give a positive length", shape, what, value));
}

void require_count(int value, int least, const char* what, const char* shape) {
    if (value < least)
        throw InputError(format("%s: %s is %d: give at least %d", shape, what, value, least));
}

void require_size(double elements, const char* shape) {
    if (elements > kMostGeneratedElements)
        throw InputError(format("%s: %.3g elements are asked for, more than %.0e: lower its counts",
                                shape, elements, kMostGeneratedElements));
}

TetMesh cut_lattice(const std::array<int, 3>& cells, bool ring) {
    const int nx = cells[0], ny = cells[1], nz = cells[2];
    const int rows = ring ? ny : ny + 1;
    TetMesh mesh;
    mesh.node.assign(static_cast<std::size_t>(nx + 1) * static_cast<std::size_t>(rows) *
                         static_cast<std::size_t>(nz + 1),
                     Vec3::Zero());
    const auto index = [&](const std::array<int, 3>& p) {
        return p[0] + (nx + 1) * (p[1] % rows + rows * p[2]);
    };
    const bool mirror_y = !ring || ny % 2 == 0;
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i) {
                const std::array<int, 3> cell = {i, j, k};
                const std::array<bool, 3> mirrored = {i % 2 == 1, mirror_y && j % 2 == 1,
                                                      k % 2 == 1};
                const bool odd_mirror = (mirrored[0] != mirrored[1]) != mirrored[2];
                for (int path = 0; path < 6; ++path) {
                    std::array<int, 3> at;
                    for (std::size_t a = 0; a < 3; ++a)
                        at[a] = cell[a] + (mirrored[a] ? 1 : 0);
                    std::array<int, 4> tet{index(at), 0, 0, 0};
                    for (std::size_t s = 0; s < 3; ++s) {
                        const auto a = static_cast<std::size_t>(kPath[path][s]);
                        at[a] += mirrored[a] ? -1 : 1;
                        tet[s + 1] = index(at);
                    }
                    if (odd_mirror != (path >= 3))
                        std::swap(tet[1], tet[2]);
                    mesh.element.insert(mesh.element.end(), tet.begin(), tet.end());
                }
            }
    return mesh;
}

} // namespace ode::soft
