#include "base/error.h"
#include "mesh/jacobian.h"
#include "mesh/quality.h"
#include "mesh/read.h"
#include "shapes.h"
#include "writers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>

namespace ode::soft {
namespace {

using testing::HasSubstr;

// Two groups, and coordinates that need all 17 digits.
TetMesh grouped_sphere() {
    TetMesh mesh = make_sphere(1.0 / 3.0, 2);
    mesh.group_name = {"the core", "shell \"b\""};
    for (std::size_t e = 0; e < mesh.element_count(); ++e)
        mesh.group.push_back(e % 3 == 0 ? 1 : 0);
    return mesh;
}

// Four tetrahedra round the z axis share edges and faces; one edge is curved.
TetMesh curved_quadratic() {
    TetMesh mesh;
    mesh.order = 2;
    mesh.node = {{0, 0, -1}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
    std::map<std::pair<int, int>, int> mid;
    for (int i = 0; i < 4; ++i) {
        const int c[4] = {0, 2 + i, 2 + (i + 1) % 4, 1};
        mesh.element.insert(mesh.element.end(), c, c + 4);
        for (const auto& [a, b] : kTetEdge) {
            const auto [at, is_new] =
                mid.try_emplace(std::minmax(c[a], c[b]), static_cast<int>(mesh.node.size()));
            if (is_new)
                mesh.node.push_back(0.5 * (mesh.node[static_cast<std::size_t>(c[a])] +
                                           mesh.node[static_cast<std::size_t>(c[b])]));
            mesh.element.push_back(at->second);
        }
    }
    mesh.node[static_cast<std::size_t>(mid.at({2, 3}))] *= 1.25;
    return mesh;
}

class ReadBack : public testing::TestWithParam<test::Dress> {};
INSTANTIATE_TEST_SUITE_P(, ReadBack, testing::ValuesIn(test::all_dresses()),
                         [](const testing::TestParamInfo<test::Dress>& dress) {
                             return dress.param.name;
                         });

TEST_P(ReadBack, KeepsLinearElementsToTheBit) {
    for (const test::Shape& shape : test::all_shapes()) {
        const TetMesh mesh = GetParam().read(GetParam().write(shape.mesh), "round");
        EXPECT_EQ(mesh.order, 1);
        EXPECT_EQ(mesh.node, shape.mesh.node);
        EXPECT_EQ(mesh.element, shape.mesh.element);
        EXPECT_TRUE(mesh.group.empty()) << shape.name;
    }
}

TEST_P(ReadBack, KeepsCurvedQuadraticElementsToTheBit) {
    const TetMesh mesh = curved_quadratic();
    const TetMesh back = GetParam().read(GetParam().write(mesh), "round");
    EXPECT_EQ(back.order, 2);
    EXPECT_EQ(back.node, mesh.node);
    EXPECT_EQ(back.element, mesh.element);
}

TEST_P(ReadBack, KeepsGroups) {
    const TetMesh mesh = grouped_sphere();
    const TetMesh back = GetParam().read(GetParam().write(mesh), "round");
    if (GetParam().read == read_vtk) {
        EXPECT_TRUE(back.group.empty()); // the format has none
        return;
    }
    EXPECT_EQ(back.group, mesh.group);
    const std::vector<std::string> numbers = {"1", "2"};
    EXPECT_EQ(back.group_name, GetParam().has_group_names ? mesh.group_name : numbers);
}

TEST_P(ReadBack, DropsNodesThatNoElementUses) {
    const TetMesh mesh = grouped_sphere();
    TetMesh written = mesh;
    written.node.insert(written.node.begin(), Vec3(9, 9, 9));
    written.node.emplace_back(8, 8, 8);
    for (int& n : written.element)
        ++n;
    const TetMesh back = GetParam().read(GetParam().write(written), "round");
    EXPECT_EQ(back.node, mesh.node);
    EXPECT_EQ(back.element, mesh.element);
}

// Corner order is a convention: a file that follows the other is no worse.
TEST_P(ReadBack, TurnsAMeshWhoseElementsAreAllInverted) {
    for (const TetMesh& mesh : {grouped_sphere(), curved_quadratic()}) {
        TetMesh mirrored = mesh;
        for (Vec3& x : mirrored.node)
            x[0] = -x[0];
        const TetMesh back = GetParam().read(GetParam().write(mirrored), "round");
        EXPECT_EQ(back.node, mirrored.node);
        double expected = 0.0, volume = 0.0;
        for (std::size_t e = 0; e < mesh.element_count(); ++e) {
            expected += element_volume(mesh, e);
            volume += element_volume(back, e);
        }
        EXPECT_NEAR(volume, expected, 1e-15);
    }
}

struct Spoilt {
    const char* what;
    std::function<void(TetMesh&)> spoil;
    const char* sentence; ///< what the refusal must hold beside file and place
    const char* cure;
};

TEST_P(ReadBack, RefusesASpoiltMeshWithFilePlaceAndCure) {
    const Spoilt cases[] = {
        {"one inverted", [](TetMesh& m) { std::swap(m.element[40], m.element[41]); }, "is inverted",
         "swap two of its nodes"},
        {"flat",
         [](TetMesh& m) {
             const auto n = m.nodes_of(5);
             const auto x = [&](std::size_t i) -> Vec3& {
                 return m.node[static_cast<std::size_t>(n[i])];
             };
             x(3) = (x(0) + x(1) + x(2)) / 3.0;
         },
         "is flat", "move its nodes apart"},
        {"nan", [](TetMesh& m) { m.node[3][1] = std::numeric_limits<double>::quiet_NaN(); }, "nan",
         "give finite coordinates"},
        {"infinite", [](TetMesh& m) { m.node[3][1] = std::numeric_limits<double>::infinity(); },
         "inf", "give finite coordinates"},
        {"beyond", [](TetMesh& m) { m.element[23] = 9999; }, "which the file does not define",
         "use the nodes"},
        {"twice", [](TetMesh& m) { m.element[23] = m.element[21]; }, "twice", "different nodes"},
        {"duplicate",
         [](TetMesh& m) { std::copy_n(m.element.begin() + 8, 4, m.element.begin() + 20); },
         "overlaps element", "remove one"},
    };
    for (const Spoilt& c : cases) {
        TetMesh mesh = make_box({1, 1, 1}, 2, 2, 2);
        c.spoil(mesh);
        try {
            GetParam().read(GetParam().write(mesh), "data/spoilt");
            FAIL() << "accepted " << c.what;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), testing::StartsWith("data/spoilt")) << c.what;
            EXPECT_THAT(error.what(),
                        testing::ContainsRegex("(, line [0-9]+|, byte [0-9]+): (node|element) "
                                               "[0-9]+ "))
                << c.what;
            EXPECT_THAT(error.what(), HasSubstr(c.sentence)) << c.what;
            EXPECT_THAT(error.what(), HasSubstr(c.cure)) << c.what;
        }
    }
}

// Cut anywhere, a file either still holds the whole mesh (only its closing words are gone) or is
// refused; it never gives a part.
TEST_P(ReadBack, RefusesATruncatedFile) {
    const TetMesh mesh = make_box({1, 1, 1}, 1, 1, 1);
    const std::string whole = GetParam().write(mesh);
    std::size_t accepted = 0;
    for (std::size_t length = 0; length < whole.size(); ++length) {
        try {
            const TetMesh back = GetParam().read(whole.substr(0, length), "cut");
            ++accepted;
            EXPECT_EQ(back.element, mesh.element) << length;
            EXPECT_EQ(back.node, mesh.node) << length;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), testing::StartsWith("cut"));
        }
    }
    EXPECT_LT(accepted, 40U); // the closing words
}

TEST_P(ReadBack, RefusesAFileWithoutTetrahedra) {
    TetMesh mesh = make_box({1, 1, 1}, 1, 1, 1);
    mesh.element.clear();
    try {
        GetParam().read(GetParam().write(mesh), "shell");
        FAIL() << "accepted";
    } catch (const InputError& error) {
        // A binary Gmsh 2.2 run of no elements is malformed by itself.
        EXPECT_THAT(error.what(),
                    testing::AnyOf(HasSubstr("holds no tetrahedra: export the volume"),
                                   HasSubstr("correct the counts"), HasSubstr("stands where")));
    }
}

} // namespace
} // namespace ode::soft
