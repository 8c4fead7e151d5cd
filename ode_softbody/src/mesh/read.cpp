#include "mesh/read.h"

#include "base/error.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace ode::soft {

namespace {

std::string load(const std::filesystem::path& path) {
    const std::string name = path.string();
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        throw InputError(format("%s: is a directory: give a file", name.c_str()));
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    std::ostringstream bytes;
    if (file.is_open() && file.peek() != std::ifstream::traits_type::eof())
        bytes << file.rdbuf();
    else if (file.is_open() && !file.bad())
        throw InputError(format("%s: the file is empty: write it again", name.c_str()));
    if (!file.is_open() || file.bad() || bytes.fail())
        throw InputError(format("%s: cannot be read (%s): check its name and permissions",
                                name.c_str(), std::strerror(errno != 0 ? errno : EIO)));
    return std::move(bytes).str();
}

} // namespace

TetMesh read_mesh(const std::string& name) {
    const std::filesystem::path path(name);
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    if (ending == ".msh")
        return read_gmsh(load(path), name);
    if (ending == ".vtk")
        return read_vtk(load(path), name);
    if (ending == ".mesh")
        return read_medit(load(path), name);
    if (ending == ".node" || ending == ".ele") {
        std::filesystem::path nodes = path, elements = path;
        (ending == ".node" ? elements : nodes)
            .replace_extension(ending == ".node" ? ".ele" : ".node");
        return read_tetgen(load(nodes), nodes.string(), load(elements), elements.string());
    }
    throw InputError(format("%s: the ending %s is unknown: give .msh, .node, .ele, .vtk or .mesh",
                            name.c_str(), ending.empty() ? "(none)" : ending.c_str()));
}

} // namespace ode::soft
