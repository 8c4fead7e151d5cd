#include "base/error.h"
#include "mesh/read.h"
#include "shapes.h"
#include "writers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace ode::soft {
namespace {

using Reader = TetMesh (*)(std::string_view, const std::string&);

struct Bad {
    const char* name;
    Reader read;
    std::string bytes;
    std::string sentence; ///< the whole refusal
};

const char kHead2[] = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const char kHead4[] = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const char kNodes2[] = "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n$EndNodes\n";
const char kVtk[] = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n";
const char kMedit[] = "MeshVersionFormatted 2\nDimension 3\n";

std::vector<Bad> bad_files() {
    return {
        {"empty", read_gmsh, "", "f, line 1: the file ends before '$MeshFormat': write it again"},
        {"other_version", read_gmsh, "$MeshFormat\n4.0 0 8\n",
         "f, line 2: the .msh version is '4.0': save as 4.1 or 2.2 (gmsh -format msh41)"},
        {"no_end", read_gmsh, std::string(kHead2) + "$Periodic\n1\n",
         "f, line 5: section '$Periodic' has no end: close it with '$EndPeriodic'"},
        {"no_elements", read_gmsh, std::string(kHead2) + kNodes2,
         "f, line 12: the file ends before its $Elements section: write it again"},
        {"wrong_count", read_gmsh, std::string(kHead2) + "$Nodes\n2\n1 0 0 0\n$EndNodes\n",
         "f, line 7: '$EndNodes' stands for a node's number: give a whole number"},
        {"too_many", read_gmsh, std::string(kHead2) + "$Nodes\n1\n1 0 0 0\n2 0 0 1\n$EndNodes\n",
         "f, line 7: '2' stands where '$EndNodes' is due: correct the counts before it"},
        {"huge_count", read_gmsh, std::string(kHead2) + "$Nodes\n4000000000000\n1 0 0 0\n",
         "f, line 5: the number of nodes is 4000000000000, but only 9 bytes follow: correct it or "
         "write the whole file"},
        {"negative_count", read_gmsh, std::string(kHead2) + "$Nodes\n-4\n1 0 0 0\n",
         "f, line 5: the number of nodes is -4: give 0 or more"},
        {"hexahedron", read_gmsh,
         std::string(kHead2) + kNodes2 + "$Elements\n1\n7 5 2 0 1 1 2 3 4 1 2 3 4\n$EndElements\n",
         "f, line 14: element 7 is a hexahedron: save the volume as tetrahedra of 4 or 10 nodes"},
        {"third_order", read_gmsh,
         std::string(kHead4) +
             "$Nodes\n0 0 0 0\n$EndNodes\n$Elements\n1 1 1 1\n3 1 29 1\n1 1 2 3 4 "
             "5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20\n$EndElements\n",
         "f, line 9: element 1 is a tetrahedron of 20 nodes: save the volume as tetrahedra of 4 or "
         "10 nodes"},
        {"mixed_orders", read_gmsh,
         std::string(kHead2) + kNodes2 +
             "$Elements\n2\n1 4 0 1 2 3 4\n2 11 0 1 2 3 4 5 6 7 8 9 10\n$EndElements\n",
         "f, line 15: element 2 has 10 nodes, those before it 4: save all elements linear or all "
         "quadratic"},
        {"doubled_node", read_gmsh,
         std::string(kHead2) + "$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n$Elements\n1\n1 4 0 1 2 3 "
                               "4\n$EndElements\n",
         "f, line 7: node 1 is defined twice: give each node a number of its own"},
        {"block_overflow", read_gmsh,
         std::string(kHead4) + "$Nodes\n1 1 1 2\n3 1 0 2\n1\n2\n0 0 0\n0 0 0\n$EndNodes\n",
         "f, line 6: node blocks hold more than the 1 nodes of the header: correct the counts"},
        {"missing_nodes", test::read_tetgen_pair, std::string("4 3 0 0\n1 0 0 0\n2 1 0 0\n") + '\0',
         "f.node, line 1: the number of nodes is 4, but only 17 bytes follow: correct it or write "
         "the whole file"},
        {"flat_world", test::read_tetgen_pair, std::string("1 2 0 0\n1 0 0\n") + '\0',
         "f.node, line 1: the dimension is 2: give 3"},
        {"wrong_nodes_per_element", test::read_tetgen_pair,
         std::string("1 3 0 0\n1 0 0 0\n") + '\0' + "1 5 0\n1 1 2 3 4 5\n",
         "f.ele, line 1: elements have 5 nodes: give 4 or 10"},
        {"letters", test::read_tetgen_pair, std::string("1 3 0 0\n1 0 zero 0\n") + '\0',
         "f.node, line 2: 'zero' stands for a coordinate: give a number"},
        {"xml", read_vtk, "<VTKFile>\n",
         "f, line 1: the first line is not '# vtk DataFile Version ...': save as legacy .vtk"},
        {"structured", read_vtk, "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_GRID\n",
         "f, line 4: the data set is 'STRUCTURED_GRID': save an UNSTRUCTURED_GRID"},
        {"wedge", read_vtk,
         std::string(kVtk) + "POINTS 1 float\n0 0 0\nCELLS 1 7\n6 0 0 0 0 0 0\nCELL_TYPES 1\n13\n",
         "f, line 8: element 0 is a wedge: save the volume as tetrahedra of 4 or 10 nodes"},
        {"cell_too_long", read_vtk,
         std::string(kVtk) + "POINTS 1 float\n0 0 0\nCELLS 1 5\n6 0 0 0 0 0 0\n",
         "f, line 8: cell 0 has 6 points, beyond the size 5 of the list: correct the counts"},
        {"falling_offsets", read_vtk,
         std::string(kVtk) + "POINTS 1 float\n0 0 0\nCELLS 3 8\nOFFSETS vtktypeint64\n0 9 8\n",
         "f, line 9: cell offset 1 is 9: let offsets rise from 0 to 8"},
        {"type_missing", read_vtk,
         std::string(kVtk) + "POINTS 1 float\n0 0 0\nCELLS 1 5\n4 0 0 0 0\nCELL_TYPES 0\n",
         "f, line 9: there are 1 cells but 0 cell types: give one each"},
        {"medit_plane", read_medit, "MeshVersionFormatted 2\nDimension 2\n",
         "f, line 2: the dimension is 2: give 3"},
        {"medit_hexahedra", read_medit, std::string(kMedit) + "Hexahedra\n1\n1 2 3 4 5 6 7 8 0\n",
         "f, line 4: element 1 is a hexahedron: save the volume as tetrahedra of 4 or 10 nodes"},
        {"medit_count", read_medit, std::string(kMedit) + "Vertices\n1\n0 0 0 0\n1 1 1 1\nEnd\n",
         "f, line 6: '1' stands where a keyword is due: correct the count of the list before it"},
        {"too_large", read_medit, std::string(kMedit) + "Vertices\n1\n0 0 1e999 0\n",
         "f, line 5: '1e999' is too large for a coordinate: give a finite number"},
    };
}

class Refuses : public testing::TestWithParam<Bad> {};
INSTANTIATE_TEST_SUITE_P(, Refuses, testing::ValuesIn(bad_files()),
                         [](const testing::TestParamInfo<Bad>& bad) { return bad.param.name; });

TEST_P(Refuses, InOneSentence) {
    try {
        GetParam().read(GetParam().bytes, "f");
        FAIL() << "accepted";
    } catch (const InputError& error) {
        EXPECT_EQ(error.what(), GetParam().sentence);
    }
}

class ReadFile : public testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    std::string write(const char* name, const std::string& bytes) const {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
        return (folder_ / name).string();
    }
    static std::string refusal(const std::string& path) {
        try {
            read_mesh(path);
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    }
    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() /
        ("ode_softbody_" +
         std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

TEST_F(ReadFile, TakesEitherFileOfTetGen) {
    const TetMesh mesh = make_box({1, 1, 1}, 1, 1, 1);
    for (const test::Dress& dress : test::all_dresses()) {
        if (dress.read != test::read_tetgen_pair)
            continue;
        const std::string bytes = dress.write(mesh);
        const std::string node = write("box.1.node", bytes.substr(0, bytes.find('\0')));
        const std::string ele = write("box.1.ele", bytes.substr(bytes.find('\0') + 1));
        EXPECT_EQ(read_mesh(node).element, mesh.element);
        EXPECT_EQ(read_mesh(ele).node, mesh.node);
    }
}

TEST_F(ReadFile, ChoosesTheFormatByAnyCaseOfTheEnding) {
    const TetMesh mesh = make_box({1, 1, 1}, 1, 1, 1);
    for (const test::Dress& dress : test::all_dresses()) {
        const char* ending = dress.read == read_gmsh    ? "box.MSH"
                             : dress.read == read_vtk   ? "box.Vtk"
                             : dress.read == read_medit ? "box.mesh"
                                                        : nullptr;
        if (ending != nullptr) {
            EXPECT_EQ(read_mesh(write(ending, dress.write(mesh))).element, mesh.element);
        }
    }
}

TEST_F(ReadFile, RefusesWhatItCannotOpen) {
    using testing::HasSubstr;
    EXPECT_THAT(refusal((folder_ / "none.msh").string()),
                HasSubstr("none.msh: cannot be read (No such file or directory): check"));
    EXPECT_THAT(refusal(write("box.stl", "solid")),
                HasSubstr("box.stl: the ending .stl is unknown: give .msh, .node"));
    EXPECT_THAT(refusal(write("empty.vtk", "")), HasSubstr("empty.vtk: the file is empty: write"));
    EXPECT_THAT(refusal(write("lonely.node", "1 3 0 0\n")),
                HasSubstr("lonely.ele: cannot be read (No such file"));
    std::filesystem::create_directories(folder_ / "folder.msh");
    EXPECT_THAT(refusal((folder_ / "folder.msh").string()),
                HasSubstr("is a directory: give a file"));
}

} // namespace
} // namespace ode::soft
