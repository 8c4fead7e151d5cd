#pragma once

#include "mesh/generate.h"
#include "mesh/tet_mesh.h"

#include <gtest/gtest.h>

#include <numbers>
#include <ostream>
#include <string>
#include <vector>

namespace ode::soft::test {

/// A generated mesh with what is known of its continuous shape.
struct Shape {
    std::string name;
    TetMesh mesh;
    std::size_t boundaries; ///< closed surfaces
    int euler;              ///< characteristic V - E + F of the surface: 2 a sphere, 0 a torus

    friend void PrintTo(const Shape& shape, std::ostream* out) { *out << shape.name; }
};

inline std::vector<Shape> all_shapes() {
    constexpr double kHalf = std::numbers::pi / 2.0;
    return {{"box", make_box({1.0, 2.0, 3.0}, 3, 2, 4), 1, 2},
            {"bar", make_bar(0.3, 0.02, 0.01, 30, 2, 1), 1, 2},
            {"plate", make_plate(0.4, 0.3, 0.01, 5, 4, 1), 1, 2},
            {"bowl", make_bowl(0.1, 0.005, kHalf, 8, 48, 1), 1, 2},
            {"uneven_bowl", make_bowl(0.1, 0.02, 2.5, 5, 17, 3), 1, 2},
            {"tube", make_tube(1.0, 0.2, 0.1, 6, 12, 2), 1, 0},
            {"odd_tube", make_tube(1.0, 0.2, 0.15, 4, 9, 1), 1, 0},
            {"sphere", make_sphere(0.5, 3), 1, 2},
            {"least_sphere", make_sphere(0.5, 1), 1, 2}};
}

inline std::string name_of(const testing::TestParamInfo<Shape>& info) { return info.param.name; }

} // namespace ode::soft::test
