#include "base/error.h"
#include "mesh/generate.h"
#include "mesh/lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ode::soft {

namespace {

// Nodes 0 (pole), then ring by ring; triangles counter-clockwise seen from the pole's inside.
struct Disc {
    std::vector<int> first; // node of each ring, pole = ring 0; last entry: node count
    std::vector<std::array<int, 3>> triangle;
};

Disc cut_disc(int rings, int around) {
    Disc disc;
    disc.first = {0, 1};
    std::vector<int> count = {1};
    for (int r = 1; r <= rings; ++r) {
        const double share = double(around) * r / rings;
        count.push_back(r == rings ? around : std::max(3, static_cast<int>(std::lround(share))));
        disc.first.push_back(disc.first.back() + count.back());
    }
    for (int r = 0; r < rings; ++r) {
        const int n = r == 0 ? 0 : count[static_cast<std::size_t>(r)];
        const int m = count[static_cast<std::size_t>(r) + 1];
        const int in = disc.first[static_cast<std::size_t>(r)];
        const int out = disc.first[static_cast<std::size_t>(r) + 1];
        const auto inner = [&](int i) { return n == 0 ? in : in + i % n; };
        const auto outer = [&](int j) { return out + j % m; };
        // Step along the ring whose next edge has the smaller angle in its middle: (2 i + 1) / n
        // against (2 j + 1) / m, in whole numbers, so that equal sectors come out equal.
        for (int i = 0, j = 0; i < n || j < m;) {
            const bool step_out =
                i == n || (j < m && std::int64_t{2 * j + 1} * n <= std::int64_t{2 * i + 1} * m);
            if (step_out) {
                disc.triangle.push_back({inner(i), outer(j), outer(j + 1)});
                ++j;
            } else {
                disc.triangle.push_back({inner(i), outer(j), inner(i + 1)});
                ++i;
            }
        }
    }
    return disc;
}

// Three tetrahedra of the prism on triangle t between two layers. Each quadrilateral side is cut
// from the lower layer's node with the smaller number, the same from both sides of it (Dompierre,
// Labbe, Vallet, Camarero 1999); `flip` takes the larger, so that layers alternate.
void cut_prism(std::array<int, 3> t, int lower, int upper, bool flip, std::vector<int>& element) {
    const auto before = [&](int a, int b) { return flip ? a > b : a < b; };
    while (before(t[1], t[0]) || before(t[2], t[0]))
        t = {t[1], t[2], t[0]}; // keeps the winding
    const auto& [a, b, c] = t;
    element.insert(element.end(),
                   {lower + a, lower + b, lower + c, upper + (before(b, c) ? c : b)});
    if (before(b, c))
        element.insert(element.end(), {lower + a, lower + b, upper + c, upper + b});
    else
        element.insert(element.end(), {lower + a, upper + b, lower + c, upper + c});
    element.insert(element.end(), {lower + a, upper + b, upper + c, upper + a});
}

} // namespace

TetMesh make_bowl(double radius, double thickness, double opening, int rings, int around,
                  int layers) {
    require_length(radius, "the radius", "bowl");
    require_length(thickness, "the thickness", "bowl");
    if (thickness >= radius)
        throw InputError(format("bowl: the thickness is %g m, the radius %g m: make the wall "
                                "thinner than the radius",
                                thickness, radius));
    if (!(opening > 0.0 && opening < std::numbers::pi))
        throw InputError(
            format("bowl: the opening is %g rad: give an angle between 0 and pi", opening));
    require_count(rings, 1, "the number of rings", "bowl");
    require_count(around, 3, "the number of elements around", "bowl");
    require_count(layers, 1, "the number of layers", "bowl");
    require_size(3.0 * rings * (around + 3.0) * layers, "bowl");

    const Disc disc = cut_disc(rings, around);
    const int per_layer = disc.first.back();
    TetMesh mesh;
    for (int l = 0; l <= layers; ++l) {
        const double r = radius - thickness + thickness * l / layers;
        mesh.node.emplace_back(0.0, 0.0, -r);
        for (int k = 1; k <= rings; ++k) {
            const double theta = opening * k / rings;
            const int n = disc.first[static_cast<std::size_t>(k) + 1] -
                          disc.first[static_cast<std::size_t>(k)];
            for (int i = 0; i < n; ++i) {
                const double phi = 2.0 * std::numbers::pi * i / n;
                mesh.node.emplace_back(r * std::sin(theta) * std::cos(phi),
                                       r * std::sin(theta) * std::sin(phi), -r * std::cos(theta));
            }
        }
    }
    for (int l = 0; l < layers; ++l)
        for (const auto& [a, b, c] : disc.triangle) // seen from outside the winding is a c b
            cut_prism({a, c, b}, l * per_layer, (l + 1) * per_layer, l % 2 == 1, mesh.element);
    return mesh;
}

TetMesh make_tube(double length, double outer_radius, double inner_radius, int along, int around,
                  int layers) {
    require_length(length, "the length", "tube");
    require_length(outer_radius, "the outer radius", "tube");
    require_length(inner_radius, "the inner radius", "tube");
    if (inner_radius >= outer_radius)
        throw InputError(format("tube: the inner radius is %g m, the outer %g m: make the inner "
                                "smaller",
                                inner_radius, outer_radius));
    require_count(along, 1, "the number of elements along", "tube");
    require_count(around, 3, "the number of elements around", "tube");
    require_count(layers, 1, "the number of layers", "tube");
    require_size(6.0 * along * around * layers, "tube");

    TetMesh mesh = cut_lattice({layers, around, along}, true);
    std::size_t at = 0;
    for (int k = 0; k <= along; ++k)
        for (int j = 0; j < around; ++j)
            for (int i = 0; i <= layers; ++i) {
                const double r = inner_radius + (outer_radius - inner_radius) * i / layers;
                const double phi = 2.0 * std::numbers::pi * j / around;
                mesh.node[at++] = {r * std::cos(phi), r * std::sin(phi), length * k / along};
            }
    return mesh;
}

} // namespace ode::soft
