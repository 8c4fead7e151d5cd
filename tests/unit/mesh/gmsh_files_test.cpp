#include "mesh/quality.h"
#include "mesh/read.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ode::soft {
namespace {

// Meshes that Gmsh 4.8.4 wrote of an eighth of a unit ball on a unit cube (data/make_data.sh).
class GmshWrote : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(, GmshWrote,
                         testing::Values("msh22_ascii_1.msh", "msh22_ascii_2.msh",
                                         "msh22_binary_1.msh", "msh22_binary_2.msh",
                                         "msh41_ascii_1.msh", "msh41_ascii_2.msh",
                                         "msh41_binary_1.msh", "msh41_binary_2.msh", "ascii_1.vtk",
                                         "ascii_2.vtk", "binary_1.vtk", "binary_2.vtk",
                                         "ascii_1.mesh", "ascii_2.mesh"),
                         [](const testing::TestParamInfo<const char*>& file) {
                             std::string name = file.param;
                             name[name.find('.')] = '_';
                             return name;
                         });

TEST_P(GmshWrote, AMeshOfTheRightVolumeInOnePiece) {
    const std::string name = GetParam();
    const TetMesh mesh = read_mesh(std::string(MESH_DATA) + "/" + name);
    const bool curved = name.find("_2.") != name.npos;
    EXPECT_EQ(mesh.order, curved ? 2 : 1);
    const MeshQuality q = measure_quality(mesh);
    EXPECT_EQ(q.parts, 1U);
    // Three chords of 90 degrees bound each face of the eighth: a tetrahedron 1/6 when straight.
    // Parabolic arcs through their middles leave a few percent of its pi / 6.
    const double ball = q.volume - 1.0;
    const double exact = std::numbers::pi / 6.0;
    if (curved) {
        EXPECT_NEAR(ball, exact, 0.03 * exact);
    } else {
        EXPECT_LT(ball, 0.9 * exact);
    }
}

TEST_P(GmshWrote, GroupsByNameWhereTheFormatHasThem) {
    const std::string name = GetParam();
    const TetMesh mesh = read_mesh(std::string(MESH_DATA) + "/" + name);
    if (name.ends_with(".vtk")) {
        EXPECT_TRUE(mesh.group.empty());
        return;
    }
    const bool named = name.ends_with(".msh"); // Gmsh puts the volume's number in a .mesh
    EXPECT_EQ(mesh.group_name, named ? (std::vector<std::string>{"ball", "the base"})
                                     : (std::vector<std::string>{"1", "2"}));
    ASSERT_EQ(mesh.group_name.size(), 2U);
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        double z = 0.0;
        for (const int n : mesh.nodes_of(e).first(4))
            z += mesh.node[static_cast<std::size_t>(n)][2];
        EXPECT_EQ(mesh.group[e], z > 0.0 ? 0 : 1);
    }
}

} // namespace
} // namespace ode::soft
