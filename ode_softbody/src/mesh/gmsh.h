#pragma once

#include "mesh/raw_mesh.h"

#include <cstdint>

namespace ode::soft {

/// What the sections of a .msh file have in common (Gmsh reference manual, "MSH file format").
struct GmshFile {
    Scan scan;
    RawMesh raw;
    bool binary = false;
    std::map<std::int64_t, std::int64_t> volume_group = {}; ///< 4.1: physical group of each volume

    GmshFile(std::string_view bytes, const std::string& name)
        : scan(bytes, name), raw(scan, scan) {}
    GmshFile(const GmshFile&) = delete;
    GmshFile& operator=(const GmshFile&) = delete;

    /// Nodes of an element of this type. @throws InputError when it is a volume but no tetrahedron
    /// of 4 or 10 nodes, or unknown.
    int nodes_of_type(std::int64_t type, std::int64_t element, std::size_t place) const;
    /// Keeps a tetrahedron in the order of kTetEdge, drops points, lines and surfaces.
    void add_element(std::int64_t type, std::int64_t number, std::span<const std::int64_t> node,
                     std::int64_t group, std::size_t place);

    /// A whole number: text, or T in a binary file.
    template <class T>
    std::int64_t integer(const char* what) {
        if (!binary)
            return scan.integer(what);
        if constexpr (sizeof(T) == 8) {
            const auto value = scan.binary<std::uint64_t>(what);
            if (value > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
                scan.refuse(what + std::string(" is beyond 2^63: write the file again"));
            return static_cast<std::int64_t>(value);
        } else {
            return scan.binary<T>(what);
        }
    }
    double real(const char* what) { return binary ? scan.binary<double>(what) : scan.real(what); }
    template <class T>
    std::size_t count(const char* what, std::size_t least_text, std::size_t least_binary) {
        const std::size_t place = scan.place();
        return scan.check_count(integer<T>(what), what, binary ? least_binary : least_text, place);
    }
};

void read_gmsh2_nodes(GmshFile& file);
void read_gmsh2_elements(GmshFile& file);
void read_gmsh4_entities(GmshFile& file);
void read_gmsh4_nodes(GmshFile& file);
void read_gmsh4_elements(GmshFile& file);

} // namespace ode::soft
