#include "writers.h"

#include "base/error.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

namespace ode::soft::test {

namespace {

template <class T>
void put(std::string& out, T value, bool swap) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (swap)
        std::reverse(bytes, bytes + sizeof(T));
    out.append(bytes, sizeof(T));
}

std::string coordinates(const Vec3& x) { return format("%.17g %.17g %.17g", x[0], x[1], x[2]); }

int group_of(const TetMesh& mesh, std::size_t e) {
    return mesh.group.empty() ? 0 : mesh.group[e] + 1; // Gmsh: 0 is none
}

// The mid-edge nodes of Gmsh end 23 13.
std::vector<int> gmsh_nodes(const TetMesh& mesh, std::size_t e) {
    const auto n = mesh.nodes_of(e);
    std::vector<int> out(n.begin(), n.end());
    if (mesh.order == 2)
        std::swap(out[8], out[9]);
    return out;
}

std::string gmsh_head(const TetMesh& mesh, const char* version, bool binary, bool swap) {
    std::string out = format("$MeshFormat\n%s %d 8\n", version, binary ? 1 : 0);
    if (binary) {
        put<std::int32_t>(out, 1, swap);
        out += '\n';
    }
    out += format("$EndMeshFormat\n$PhysicalNames\n%zu\n", mesh.group_name.size());
    for (std::size_t g = 0; g < mesh.group_name.size(); ++g)
        out += format("3 %zu \"%s\"\n", g + 1, mesh.group_name[g].c_str());
    return out + "$EndPhysicalNames\n";
}

std::string gmsh2(const TetMesh& mesh, bool binary, bool swap) {
    std::string out = gmsh_head(mesh, "2.2", binary, swap);
    out += format("$Nodes\n%zu\n", mesh.node.size());
    for (std::size_t i = 0; i < mesh.node.size(); ++i) {
        if (!binary) {
            out += format("%zu %s\n", i + 1, coordinates(mesh.node[i]).c_str());
            continue;
        }
        put(out, static_cast<std::int32_t>(i + 1), swap);
        for (const double c : mesh.node[i])
            put(out, c, swap);
    }
    const int type = mesh.order == 1 ? 4 : 11;
    // A point (type 15) comes first: to be ignored.
    out += format("%s$EndNodes\n$Elements\n%zu\n", binary ? "\n" : "", mesh.element_count() + 1);
    if (binary) {
        for (const int value : {15, 1, 2, 1, 0, 1, 1, type, int(mesh.element_count()), 2})
            put(out, value, swap);
    } else {
        out += "1 15 2 0 1 1\n";
    }
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        if (binary) {
            for (const int value : {int(e) + 2, group_of(mesh, e), 1})
                put(out, value, swap);
            for (const int n : gmsh_nodes(mesh, e))
                put(out, n + 1, swap);
        } else {
            out += format("%zu %d 2 %d 1", e + 2, type, group_of(mesh, e));
            for (const int n : gmsh_nodes(mesh, e))
                out += format(" %d", n + 1);
            out += '\n';
        }
    }
    return out + (binary ? "\n" : "") + "$EndElements\n";
}

// One volume a group. Node numbers are 10 i + 5, in blocks of at most 7, the last block first.
std::string gmsh4(const TetMesh& mesh, bool binary, bool swap) {
    using Size = std::uint64_t;
    std::string out = gmsh_head(mesh, "4.1", binary, swap);
    const auto tag = [&](int value) {
        binary ? put(out, value, swap) : void(out += format("%d ", value));
    };
    const auto size = [&](std::size_t value) {
        binary ? put(out, Size{value}, swap) : void(out += format("%zu ", value));
    };
    const auto real = [&](double value) {
        binary ? put(out, value, swap) : void(out += format("%.17g ", value));
    };
    const auto end_line = [&] { out += binary ? "" : "\n"; };

    const std::size_t volumes = std::max<std::size_t>(1, mesh.group_name.size());
    out += "$Entities\n";
    for (const std::size_t count : {std::size_t{1}, std::size_t{0}, std::size_t{0}, volumes})
        size(count);
    end_line();
    tag(1);
    for (int c = 0; c < 3; ++c)
        real(0.0);
    size(0);
    end_line();
    for (std::size_t v = 0; v < volumes; ++v) {
        tag(100 + int(v));
        for (int c = 0; c < 6; ++c)
            real(0.5);
        size(mesh.group_name.empty() ? 0 : 1);
        if (!mesh.group_name.empty())
            tag(int(v) + 1);
        size(2);
        tag(1);
        tag(-2);
        end_line();
    }
    out += binary ? "\n$EndEntities\n$Nodes\n" : "$EndEntities\n$Nodes\n";

    constexpr std::size_t kBlock = 7;
    const std::size_t blocks = (mesh.node.size() + kBlock - 1) / kBlock;
    for (const std::size_t value : {blocks, mesh.node.size(), std::size_t{5}, std::size_t{5}})
        size(value);
    end_line();
    for (std::size_t b = blocks; b-- > 0;) {
        const std::size_t first = b * kBlock, last = std::min(first + kBlock, mesh.node.size());
        const bool parametric = b % 2 == 1;
        tag(2);
        tag(1);
        tag(parametric ? 1 : 0);
        size(last - first);
        end_line();
        for (std::size_t i = first; i < last; ++i) {
            size(10 * i + 5);
            end_line();
        }
        for (std::size_t i = first; i < last; ++i) {
            for (const double c : mesh.node[i])
                real(c);
            for (int p = 0; parametric && p < 2; ++p)
                real(0.25);
            end_line();
        }
    }
    out += binary ? "\n$EndNodes\n$Elements\n" : "$EndNodes\n$Elements\n";

    // One block an element keeps the order of elements whatever their groups.
    for (const std::size_t value :
         {mesh.element_count(), mesh.element_count(), std::size_t{1}, mesh.element_count()})
        size(value);
    end_line();
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        tag(3);
        tag(100 + (mesh.group.empty() ? 0 : mesh.group[e]));
        tag(mesh.order == 1 ? 4 : 11);
        size(1);
        end_line();
        size(e + 1);
        for (const int n : gmsh_nodes(mesh, e))
            size(std::size_t(10 * n + 5));
        end_line();
    }
    return out + (binary ? "\n" : "") + "$EndElements\n";
}

std::string tetgen(const TetMesh& mesh, int base) {
    // TetGen 1.5 lists edges 23 03 01 12 13 20.
    constexpr std::size_t kMid[6] = {9, 7, 4, 5, 8, 6};
    std::string out = format("# nodes\n%zu 3 1 1\n", mesh.node.size());
    for (std::size_t i = 0; i < mesh.node.size(); ++i)
        out += format("%zu %s 0.5 -1 # a node\n", i + std::size_t(base),
                      coordinates(mesh.node[i]).c_str());
    out += '\0';
    out += format("%zu %d %d\n", mesh.element_count(), mesh.nodes_per_element(),
                  mesh.group.empty() ? 0 : 1);
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        const auto n = mesh.nodes_of(e);
        out += format("%zu", e + std::size_t(base));
        for (const int corner : n.first(4))
            out += format("  %d", corner + base);
        for (std::size_t i = 0; mesh.order == 2 && i < 6; ++i)
            out += format("  %d", n[kMid[i]] + base);
        out += mesh.group.empty() ? "\n" : format("  %d\n", group_of(mesh, e));
    }
    return out + "# Generated by a test\n";
}

std::string vtk(const TetMesh& mesh, bool binary, int version) {
    const bool swap = std::endian::native == std::endian::little;
    const auto per = std::size_t(mesh.nodes_per_element());
    const auto index = [&](std::string& out, long value) {
        if (!binary)
            out += format("%ld ", value);
        else if (version == 5)
            put(out, std::int64_t{value}, swap);
        else
            put(out, static_cast<std::int32_t>(value), swap);
    };
    std::string out =
        format("# vtk DataFile Version %d.%d\na title\n%s\nDATASET UNSTRUCTURED_GRID\n", version,
               version == 5 ? 1 : 2, binary ? "BINARY" : "ASCII");
    out += format("POINTS %zu double\n", mesh.node.size());
    for (const Vec3& x : mesh.node)
        for (const double c : x)
            binary ? put(out, c, swap) : void(out += format("%.17g ", c));
    out += "\n";
    // A triangle (type 5) comes first: to be ignored.
    const std::size_t cells = mesh.element_count() + 1;
    const std::size_t points = 3 + per * mesh.element_count();
    if (version == 5) {
        out += format("METADATA\nINFORMATION 0\n\nCELLS %zu %zu\nOFFSETS vtktypeint64\n", cells + 1,
                      points);
        index(out, 0);
        for (std::size_t e = 0; e < cells; ++e)
            index(out, long(3 + per * e));
        out += "\nCONNECTIVITY vtktypeint64\n";
    } else {
        out += format("CELLS %zu %zu\n", cells, points + cells);
        index(out, 3);
    }
    for (const int n : {0, 1, 2})
        index(out, n);
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        if (version != 5)
            index(out, long(per));
        for (const int n : mesh.nodes_of(e))
            index(out, n);
    }
    out += format("\nCELL_TYPES %zu\n", cells);
    for (std::size_t e = 0; e < cells; ++e) {
        const int type = e == 0 ? 5 : mesh.order == 1 ? 10 : 24;
        binary ? put(out, type, swap) : void(out += format("%d\n", type));
    }
    return out + "\nCELL_DATA 0\n";
}

std::string medit(const TetMesh& mesh) {
    std::string out = "MeshVersionFormatted 2\nDimension\n3\n# a comment\nVertices\n";
    out += format("%zu\n", mesh.node.size());
    for (const Vec3& x : mesh.node)
        out += coordinates(x) + " 0\n";
    out += "Triangles\n1\n1 2 3 0\nRequiredVertices\n1\n1\n";
    out +=
        format("%s\n%zu\n", mesh.order == 1 ? "Tetrahedra" : "TetrahedraP2", mesh.element_count());
    for (std::size_t e = 0; e < mesh.element_count(); ++e) {
        for (const int n : mesh.nodes_of(e))
            out += format("%d ", n + 1);
        out += format("%d\n", group_of(mesh, e));
    }
    return out + "End\n";
}

} // namespace

TetMesh read_tetgen_pair(std::string_view bytes, const std::string& name) {
    const std::size_t cut = std::min(bytes.find('\0'), bytes.size());
    const std::size_t second = std::min(cut + 1, bytes.size());
    return read_tetgen(bytes.substr(0, cut), name + ".node", bytes.substr(second), name + ".ele");
}

const std::vector<Dress>& all_dresses() {
    using M = const TetMesh&;
    static const std::vector<Dress> dresses = {
        {"gmsh22_ascii", [](M m) { return gmsh2(m, false, false); }, read_gmsh, true},
        {"gmsh22_binary", [](M m) { return gmsh2(m, true, false); }, read_gmsh, true},
        {"gmsh22_binary_swapped", [](M m) { return gmsh2(m, true, true); }, read_gmsh, true},
        {"gmsh41_ascii", [](M m) { return gmsh4(m, false, false); }, read_gmsh, true},
        {"gmsh41_binary", [](M m) { return gmsh4(m, true, false); }, read_gmsh, true},
        {"gmsh41_binary_swapped", [](M m) { return gmsh4(m, true, true); }, read_gmsh, true},
        {"tetgen_from_0", [](M m) { return tetgen(m, 0); }, read_tetgen_pair, false},
        {"tetgen_from_1", [](M m) { return tetgen(m, 1); }, read_tetgen_pair, false},
        {"vtk4_ascii", [](M m) { return vtk(m, false, 4); }, read_vtk, false},
        {"vtk4_binary", [](M m) { return vtk(m, true, 4); }, read_vtk, false},
        {"vtk5_ascii", [](M m) { return vtk(m, false, 5); }, read_vtk, false},
        {"vtk5_binary", [](M m) { return vtk(m, true, 5); }, read_vtk, false},
        {"medit", [](M m) { return medit(m); }, read_medit, false}};
    return dresses;
}

} // namespace ode::soft::test
