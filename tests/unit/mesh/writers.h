#pragma once

#include "mesh/read.h"
#include "mesh/tet_mesh.h"

#include <string>
#include <string_view>
#include <vector>

namespace ode::soft::test {

/// A file format in one of its dresses: how to write a mesh in it and how to read it back.
struct Dress {
    std::string name;
    std::string (*write)(const TetMesh&);
    TetMesh (*read)(std::string_view bytes, const std::string& name);
    bool has_group_names;
};

/// Every format that the library reads: ASCII, binary of this byte order and, where the format
/// allows it, of the other.
const std::vector<Dress>& all_dresses();

/// Both files of TetGen in one string, parted by a zero byte, so that they pass for one file in
/// mutation tests.
TetMesh read_tetgen_pair(std::string_view bytes, const std::string& name);

} // namespace ode::soft::test
