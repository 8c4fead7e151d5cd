// Bodies that no constant of the library was chosen on: other shapes, materials and meshes than
// pitch_cases().
#include "support/pitch_cases.h"

#include "mesh/generate.h"
#include "mesh/promote.h"

#include <cmath>
#include <numbers>

namespace ode::soft {
namespace {

const Solid kAluminium{.young = 69e9, .poisson = 0.33, .density = 2700};
const Solid kSteel{.young = 200e9, .poisson = 0.29, .density = 7850};
const Solid kBrass{.young = 100e9, .poisson = 0.34, .density = 8500};
const Solid kGlass{.young = 70e9, .poisson = 0.22, .density = 2500};
const Solid kWood{.young = 11e9, .poisson = 0.4, .density = 600};
const Solid kRubber{.young = 5e6, .poisson = 0.49, .density = 1100};

/// Without the elements whose centroid is where `gone` says.
TetMesh without(const TetMesh& mesh, const std::function<bool(const Vec3&)>& gone) {
    TetMesh out = mesh;
    out.element.clear();
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        Vec3 centroid = Vec3::Zero();
        for (const int n : mesh.nodes_of(e))
            centroid += 0.25 * mesh.node[static_cast<std::size_t>(n)];
        const auto n = mesh.nodes_of(e);
        if (!gone(centroid))
            out.element.insert(out.element.end(), n.begin(), n.end());
    }
    return out;
}

TetMesh wedge() {
    TetMesh mesh = make_bar(0.2, 0.03, 0.016, 10, 2, 1);
    for (Vec3& x : mesh.node) {
        x.y() *= 1 - 2.5 * x.x(); // to half its width
        x.z() *= 1 - 3.5 * x.x(); // to 0.3 of its thickness
    }
    return mesh;
}

/// Inner nodes displaced in all directions, those of a face within it.
TetMesh ragged_bar() {
    TetMesh mesh = make_bar(0.24, 0.03, 0.02, 10, 2, 2);
    const Vec3 low(0, -0.015, -0.01), high(0.24, 0.015, 0.01), step(0.024, 0.015, 0.01);
    for (std::size_t i = 0; i < mesh.node.size(); ++i) {
        Vec3& x = mesh.node[i];
        for (int axis = 0; axis < 3; ++axis)
            if (x[axis] - low[axis] > 1e-9 && high[axis] - x[axis] > 1e-9)
                x[axis] += 0.22 * step[axis] * std::sin(5.0 * static_cast<double>(i) + 2 * axis);
    }
    return mesh;
}

} // namespace

std::vector<PitchCase> held_out_cases() {
    const auto left = [](const Vec3& x) { return x.x() < 1e-9; };
    std::vector<PitchCase> cases;
    cases.push_back({"L block",
                     without(make_box({0.1, 0.1, 0.03}, 6, 6, 2),
                             [](const Vec3& x) { return x.x() > 0 && x.y() > 0; }),
                     {kAluminium},
                     {},
                     40000});
    cases.push_back({"thick ring", make_tube(0.03, 0.05, 0.03, 2, 16, 2), {kBrass}, {}, 30000});
    cases.push_back({"clamped wedge", wedge(), {kGlass}, left, 20000});
    cases.push_back({"clamped thick plate",
                     promote_to_quadratic(make_plate(0.2, 0.15, 0.02, 6, 5, 1)),
                     {kSteel},
                     [](const Vec3& x) {
                         return std::abs(x.x()) > 0.1 - 1e-9 || std::abs(x.y()) > 0.075 - 1e-9;
                     },
                     30000});
    cases.push_back({"gong", make_bowl(0.15, 0.004, 0.7, 5, 18, 1), {kBrass}, {}, 8000});
    cases.push_back({"clamped ragged bar", ragged_bar(), {kWood}, left, 30000});
    cases.push_back({"clamped rubber plate",
                     make_plate(0.1, 0.08, 0.01, 6, 5, 1),
                     {kRubber},
                     [](const Vec3& x) { return x.x() < -0.05 + 1e-9; },
                     1000});
    cases.push_back(
        {"notched bar",
         without(make_bar(0.2, 0.02, 0.02, 11, 2, 2),
                 [](const Vec3& x) { return x.z() > 0 && std::abs(x.x() - 0.1) < 0.0091; }),
         {kSteel},
         {},
         20000});
    cases.push_back(
        {"frame",
         without(make_box({0.12, 0.12, 0.012}, 6, 6, 1),
                 [](const Vec3& x) { return std::abs(x.x()) < 0.04 && std::abs(x.y()) < 0.04; }),
         {kAluminium},
         {},
         20000});
    return cases;
}

} // namespace ode::soft
