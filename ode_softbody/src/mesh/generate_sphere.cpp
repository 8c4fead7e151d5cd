#include "mesh/generate.h"
#include "mesh/lattice.h"
#include "mesh/octahedron.h"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>

namespace ode::soft {

namespace {

constexpr double kGolden = std::numbers::phi;

constexpr double kIcosahedron[12][3] = {{-1, kGolden, 0},  {1, kGolden, 0},   {-1, -kGolden, 0},
                                        {1, -kGolden, 0},  {0, -1, kGolden},  {0, 1, kGolden},
                                        {0, -1, -kGolden}, {0, 1, -kGolden},  {kGolden, 0, -1},
                                        {kGolden, 0, 1},   {-kGolden, 0, -1}, {-kGolden, 0, 1}};

// Counter-clockwise seen from outside.
constexpr int kIcosahedronFace[20][3] = {
    {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};

// A lattice point of one cone: steps from the centre towards each of its three outer corners.
using Steps = std::array<int, 3>;

class Ball {
public:
    Ball(double radius, int refinement) : radius_(radius), refinement_(refinement) {}

    // Node of a lattice point; neighbouring cones name their common points alike.
    int node(const int (&face)[3], const Steps& steps) {
        std::array<std::array<int, 2>, 3> name{}; // (icosahedron node + 1, steps); zeros: unused
        for (std::size_t i = 0; i < 3; ++i)
            if (steps[i] > 0)
                name[i] = {face[i] + 1, steps[i]};
        std::sort(name.begin(), name.end());
        const auto [at, is_new] = index_.try_emplace(name, static_cast<int>(mesh.node.size()));
        if (is_new)
            mesh.node.push_back(place(name));
        return at->second;
    }

    TetMesh mesh;

private:
    // Summed in the order of the name, not of the face: the same bits whoever asks first.
    Vec3 place(const std::array<std::array<int, 2>, 3>& name) const {
        Vec3 direction = Vec3::Zero();
        int layer = 0;
        for (const auto& [corner, steps] : name) {
            if (steps == 0)
                continue;
            direction += steps * Vec3(kIcosahedron[corner - 1]);
            layer += steps;
        }
        return layer == 0 ? direction : (radius_ * layer / refinement_) * direction.normalized();
    }

    double radius_;
    int refinement_;
    std::map<std::array<std::array<int, 2>, 3>, int> index_;
};

} // namespace

TetMesh make_sphere(double radius, int refinement) {
    require_length(radius, "the radius", "sphere");
    require_count(refinement, 1, "the refinement", "sphere");
    require_size(20.0 * refinement * refinement * double(refinement), "sphere");

    Ball ball(radius, refinement);
    auto& element = ball.mesh.element;
    for (const auto& face : kIcosahedronFace)
        for (int i = 0; i < refinement; ++i)
            for (int j = 0; i + j < refinement; ++j)
                for (int k = 0; i + j + k < refinement; ++k) {
                    const auto at = [&](int di, int dj, int dk) {
                        return ball.node(face, {i + di, j + dj, k + dk});
                    };
                    const int left = refinement - (i + j + k);
                    element.insert(element.end(),
                                   {at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(0, 0, 1)});
                    if (left >= 2) {
                        const std::array<std::array<int, 2>, 3> opposite = {
                            {{at(0, 1, 1), at(1, 0, 0)},
                             {at(1, 0, 1), at(0, 1, 0)},
                             {at(1, 1, 0), at(0, 0, 1)}}};
                        cut_octahedron(ball.mesh.node, opposite, element);
                    }
                    if (left >= 3)
                        element.insert(element.end(),
                                       {at(1, 1, 1), at(0, 1, 1), at(1, 1, 0), at(1, 0, 1)});
                }
    return std::move(ball.mesh);
}

} // namespace ode::soft
