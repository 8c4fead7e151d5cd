#include "modal/block_system.h"

#include "modal/avx2.h"
#include "modal/block_rows.h"

#include <cassert>

namespace ode::soft {
namespace {

template <int lanes>
[[gnu::always_inline]] inline void mass_rows(const BlockSystem& s, const double* x, double* y,
                                             std::size_t stride) {
    const std::size_t nodes = s.node_count();
    for (std::size_t i = 0; i < nodes; ++i) {
        double sum[3][lanes] = {};
        for (int p = s.start[i]; p < s.start[i + 1]; ++p) {
            const double m = s.mass[static_cast<std::size_t>(p)];
            const double* from =
                x + 3 * stride * static_cast<std::size_t>(s.column[static_cast<std::size_t>(p)]);
            for (int c = 0; c < 3; ++c, from += stride)
                for (int v = 0; v < lanes; ++v)
                    sum[c][v] += m * from[v];
        }
        double* to = y + 3 * stride * i;
        for (int r = 0; r < 3; ++r, to += stride)
            for (int v = 0; v < lanes; ++v)
                to[v] = sum[r][v];
    }
}

template <int lanes>
ODE_SOFTBODY_AVX2 void stiffness_wide(const BlockSystem& s, const double* x, double* y,
                                      std::size_t stride) {
    stiffness_rows<double, lanes>(s, s.stiffness.data(), x, y, stride);
}
template <int lanes>
ODE_SOFTBODY_AVX2 void mass_wide(const BlockSystem& s, const double* x, double* y,
                                 std::size_t stride) {
    mass_rows<lanes>(s, x, y, stride);
}

} // namespace

void multiply_stiffness(const BlockSystem& system, const RowMatrix& x, RowMatrix& y) {
    assert(x.rows() == system.size());
    y.resize(x.rows(), x.cols());
    const auto stride = static_cast<std::size_t>(x.cols());
    in_lanes(stride, [&]<int lanes>(std::integral_constant<int, lanes>, std::size_t v) {
        if (has_avx2())
            stiffness_wide<lanes>(system, x.data() + v, y.data() + v, stride);
        else
            stiffness_rows<double, lanes>(system, system.stiffness.data(), x.data() + v,
                                          y.data() + v, stride);
    });
}

void multiply_mass(const BlockSystem& system, const RowMatrix& x, RowMatrix& y) {
    assert(x.rows() == system.size());
    y.resize(x.rows(), x.cols());
    const auto stride = static_cast<std::size_t>(x.cols());
    in_lanes(stride, [&]<int lanes>(std::integral_constant<int, lanes>, std::size_t v) {
        if (has_avx2())
            mass_wide<lanes>(system, x.data() + v, y.data() + v, stride);
        else
            mass_rows<lanes>(system, x.data() + v, y.data() + v, stride);
    });
}

BlockSystem restrict_to(const BlockSystem& system, const std::vector<char>& keep) {
    const std::size_t nodes = system.node_count();
    std::vector<int> renumbered(nodes, -1);
    BlockSystem out;
    for (std::size_t i = 0; i < nodes; ++i)
        if (keep[i]) {
            renumbered[i] = static_cast<int>(out.position.size());
            out.position.push_back(system.position[i]);
        }
    out.start.push_back(0);
    for (std::size_t i = 0; i < nodes; ++i) {
        if (!keep[i])
            continue;
        for (int p = system.start[i]; p < system.start[i + 1]; ++p) {
            const auto pair = static_cast<std::size_t>(p);
            const int column = renumbered[static_cast<std::size_t>(system.column[pair])];
            if (column < 0)
                continue;
            out.column.push_back(column);
            out.mass.push_back(system.mass[pair]);
            const double* k = &system.stiffness[9 * pair];
            out.stiffness.insert(out.stiffness.end(), k, k + 9);
        }
        out.start.push_back(static_cast<int>(out.column.size()));
    }
    return out;
}

std::vector<int> connected_parts(const BlockSystem& system) {
    std::vector<int> part(system.node_count(), -1), stack;
    int parts = 0;
    for (std::size_t seed = 0; seed < part.size(); ++seed) {
        if (part[seed] >= 0)
            continue;
        part[seed] = parts;
        stack.push_back(static_cast<int>(seed));
        while (!stack.empty()) {
            const auto i = static_cast<std::size_t>(stack.back());
            stack.pop_back();
            for (int p = system.start[i]; p < system.start[i + 1]; ++p) {
                const int j = system.column[static_cast<std::size_t>(p)];
                if (part[static_cast<std::size_t>(j)] < 0) {
                    part[static_cast<std::size_t>(j)] = parts;
                    stack.push_back(j);
                }
            }
        }
        ++parts;
    }
    return part;
}

} // namespace ode::soft
