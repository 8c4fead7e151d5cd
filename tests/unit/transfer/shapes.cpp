#include "unit/transfer/shapes.h"

#include "transfer/coarsen.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace ode::sound::test {

BoundaryMesh sphere(int level) {
    BoundaryMesh m;
    const double g = (1.0 + std::sqrt(5.0)) / 2.0;
    for (const double s : {1.0, -1.0})
        for (const double t : {1.0, -1.0})
            for (const Vec3& v : {Vec3(0, s, t * g), Vec3(s, t * g, 0), Vec3(t * g, 0, s)})
                m.node.push_back(v.normalized());
    const auto joined = [&](int a, int b) {
        return (m.node[static_cast<std::size_t>(a)] - m.node[static_cast<std::size_t>(b)]).norm() <
               1.2; // edges are 1.05 long, the next distance is 1.7
    };
    for (int a = 0; a < 12; ++a)
        for (int b = a + 1; b < 12; ++b)
            for (int c = b + 1; c < 12; ++c) {
                if (!joined(a, b) || !joined(b, c) || !joined(c, a))
                    continue;
                const Vec3 &x = m.node[static_cast<std::size_t>(a)],
                           &y = m.node[static_cast<std::size_t>(b)],
                           &z = m.node[static_cast<std::size_t>(c)];
                if ((y - x).cross(z - x).dot(x) > 0)
                    m.triangle.push_back({a, b, c});
                else
                    m.triangle.push_back({a, c, b});
            }
    std::vector<std::array<int, 2>> parents;
    for (int l = 0; l < level; ++l) {
        m = split(m, parents);
        for (Vec3& x : m.node)
            x.normalize();
    }
    return m;
}

BoundaryMesh disc(double thickness, int rings) {
    BoundaryMesh m;
    for (const double side : {0.5, -0.5}) {
        const int base = static_cast<int>(m.node.size());
        const auto at = [&](int ring, int i) {
            return ring == 0 ? base : base + 1 + 3 * ring * (ring - 1) + i % (6 * ring);
        };
        const auto add = [&](int a, int b, int c) {
            if (side > 0)
                m.triangle.push_back({a, b, c});
            else
                m.triangle.push_back({a, c, b});
        };
        m.node.emplace_back(0, 0, side * thickness);
        for (int r = 1; r <= rings; ++r)
            for (int i = 0; i < 6 * r; ++i) {
                const double phi = std::numbers::pi * i / (3.0 * r);
                // Narrower rings at the rim, where the flow is singular.
                const double radius = std::sin(0.5 * std::numbers::pi * r / rings);
                m.node.emplace_back(radius * std::cos(phi), radius * std::sin(phi),
                                    side * thickness);
            }
        for (int r = 1; r <= rings; ++r)
            for (int s = 0; s < 6; ++s)
                for (int i = 0; i < r; ++i) {
                    add(at(r - 1, s * (r - 1) + i), at(r, s * r + i), at(r, s * r + i + 1));
                    if (i + 1 < r)
                        add(at(r - 1, s * (r - 1) + i), at(r, s * r + i + 1),
                            at(r - 1, s * (r - 1) + i + 1));
                }
    }
    const int half = static_cast<int>(m.node.size()) / 2;
    const int first = half - 6 * rings;
    for (int i = 0; i < 6 * rings; ++i) {
        const int a = first + i, b = first + (i + 1) % (6 * rings);
        m.triangle.push_back({a, a + half, b + half});
        m.triangle.push_back({a, b + half, b});
    }
    return m;
}

BoundaryMesh bowl(double thickness, int rings) {
    BoundaryMesh m = disc(thickness, rings);
    for (Vec3& x : m.node) { // the disc's radii are the sines of even steps
        const double rim = std::min(1.0, std::hypot(x[0], x[1])), r = 1.0 + x[2];
        x = r * Vec3(x[0], x[1], std::sqrt(1.0 - rim * rim));
    }
    return m;
}

BoundaryMesh block(const Vec3& size, const std::array<int, 3>& cells) {
    BoundaryMesh m;
    std::map<std::array<int, 3>, int> number;
    const auto node = [&](const std::array<int, 3>& at) {
        const auto [found, fresh] = number.try_emplace(at, static_cast<int>(m.node.size()));
        if (fresh) {
            Vec3 x;
            for (std::size_t k = 0; k < 3; ++k)
                x[static_cast<int>(k)] =
                    size[static_cast<int>(k)] * (static_cast<double>(at[k]) / cells[k] - 0.5);
            m.node.push_back(x);
        }
        return found->second;
    };
    for (std::size_t k = 0; k < 3; ++k)
        for (const bool upper : {false, true}) {
            const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
            for (int i = 0; i < cells[u]; ++i)
                for (int j = 0; j < cells[v]; ++j) {
                    const auto corner = [&](int di, int dj) {
                        std::array<int, 3> at{};
                        at[k] = upper ? cells[k] : 0;
                        at[u] = i + di;
                        at[v] = j + dj;
                        return node(at);
                    };
                    const int a = corner(0, 0), b = corner(1, 0), c = corner(1, 1),
                              d = corner(0, 1);
                    if (upper) {
                        m.triangle.push_back({a, b, c});
                        m.triangle.push_back({a, c, d});
                    } else {
                        m.triangle.push_back({a, c, b});
                        m.triangle.push_back({a, d, c});
                    }
                }
        }
    return m;
}

} // namespace ode::sound::test
