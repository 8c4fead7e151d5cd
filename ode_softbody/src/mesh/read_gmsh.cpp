#include "base/error.h"
#include "mesh/gmsh.h"
#include "mesh/read.h"

namespace ode::soft {

namespace {

struct ElementType {
    int nodes;          // 0: unknown
    const char* volume; // what to call a volume element that is refused
};

// By Gmsh's number of the type, from 1.
constexpr ElementType kElementType[] = {{2, nullptr},
                                        {3, nullptr},
                                        {4, nullptr},
                                        {4, nullptr},
                                        {8, "a hexahedron"},
                                        {6, "a prism"},
                                        {5, "a pyramid"},
                                        {3, nullptr},
                                        {6, nullptr},
                                        {9, nullptr},
                                        {10, nullptr},
                                        {27, "a hexahedron"},
                                        {18, "a prism"},
                                        {14, "a pyramid"},
                                        {1, nullptr},
                                        {8, nullptr},
                                        {20, "a hexahedron"},
                                        {15, "a prism"},
                                        {13, "a pyramid"},
                                        {9, nullptr},
                                        {10, nullptr},
                                        {12, nullptr},
                                        {15, nullptr},
                                        {15, nullptr},
                                        {21, nullptr},
                                        {4, nullptr},
                                        {5, nullptr},
                                        {6, nullptr},
                                        {20, "a tetrahedron of 20 nodes"},
                                        {35, "a tetrahedron of 35 nodes"},
                                        {56, "a tetrahedron of 56 nodes"}};
constexpr std::int64_t kTetrahedron = 4, kQuadraticTetrahedron = 11;

void read_format(GmshFile& file, bool& is_4) {
    Scan& scan = file.scan;
    scan.expect("$MeshFormat");
    const std::string version(scan.word());
    if (version != "2.2" && version != "4.1")
        scan.refuse(format("the .msh version is %s: save as 4.1 or 2.2 (gmsh -format msh41)",
                           quote(version).c_str()));
    is_4 = version == "4.1";
    const std::int64_t type = scan.integer("the file type");
    if (type != 0 && type != 1)
        scan.refuse(format("the file type is %lld: give 0 (ASCII) or 1 (binary)",
                           static_cast<long long>(type)));
    const std::int64_t size = scan.integer("the data size");
    if (size != 8)
        scan.refuse(format("the data size is %lld: save with 8-byte numbers",
                           static_cast<long long>(size)));
    if (type == 1) {
        scan.line();
        scan.set_binary(false);
        const auto one = scan.binary<std::uint32_t>("the byte order");
        if (one != 1 && one != 0x01000000U)
            scan.refuse("the byte order is neither of this machine nor its reverse: write the file "
                        "again, unchanged by text transfer");
        scan.set_binary(one != 1);
        file.binary = true;
    }
    scan.expect("$EndMeshFormat");
}

// dimension tag "name", one a line.
void read_names(GmshFile& file) {
    Scan& scan = file.scan;
    const std::size_t names = scan.count("the number of physical names", 6);
    for (std::size_t i = 0; i < names; ++i) {
        const std::int64_t dimension = scan.integer("the dimension of a physical name");
        const std::int64_t tag = scan.integer("the tag of a physical name");
        const std::size_t place = scan.place();
        const std::string_view rest = scan.line();
        const std::size_t open = rest.find('"'), close = rest.rfind('"');
        if (open == rest.npos || close == open)
            scan.refuse("a physical name is not in quotes: write it as \"name\"", place);
        if (dimension == 3)
            file.raw.name_group(tag, std::string(rest.substr(open + 1, close - open - 1)));
    }
}

} // namespace

int GmshFile::nodes_of_type(std::int64_t type, std::int64_t element, std::size_t place) const {
    if (type < 1 || type > static_cast<std::int64_t>(std::size(kElementType)))
        scan.refuse(format("element %lld is of type %lld: save with tetrahedra of 4 or 10 nodes "
                           "(types 4 and 11)",
                           static_cast<long long>(element), static_cast<long long>(type)),
                    place);
    const ElementType& known = kElementType[type - 1];
    if (known.volume != nullptr)
        refuse_kind(scan, place, element, known.volume);
    return known.nodes;
}

void GmshFile::add_element(std::int64_t type, std::int64_t number,
                           std::span<const std::int64_t> node, std::int64_t group,
                           std::size_t place) {
    if (type == kTetrahedron) {
        raw.add_element(number, node, group, place);
    } else if (type == kQuadraticTetrahedron) {
        // Gmsh ends with edges 23 13.
        const std::int64_t ordered[10] = {node[0], node[1], node[2], node[3], node[4],
                                          node[5], node[6], node[7], node[9], node[8]};
        raw.add_element(number, ordered, group, place);
    }
}

TetMesh read_gmsh(std::string_view bytes, const std::string& name) {
    GmshFile file(bytes, name);
    bool is_4 = false;
    read_format(file, is_4);
    Scan& scan = file.scan;
    bool nodes = false, elements = false;
    while (!(nodes && elements)) {
        const std::string section(scan.word());
        if (section.empty())
            scan.refuse(format("the file ends before its $%s section: write it again",
                               nodes ? "Elements" : "Nodes"));
        if (section.front() != '$')
            scan.refuse(format("%s stands where a section ($Nodes, $Elements) is due: correct the "
                               "counts before it",
                               quote(section).c_str()));
        const std::size_t place = scan.place();
        if (is_4 && file.binary && section != "$PhysicalNames")
            scan.line(); // data begin behind it
        const std::string end = "$End" + section.substr(1);
        if (section == "$PhysicalNames") {
            read_names(file);
        } else if (section == "$Entities" && is_4) {
            read_gmsh4_entities(file);
        } else if (section == "$Nodes" && !nodes) {
            is_4 ? read_gmsh4_nodes(file) : read_gmsh2_nodes(file);
            nodes = true;
        } else if (section == "$Elements" && !elements) {
            is_4 ? read_gmsh4_elements(file) : read_gmsh2_elements(file);
            elements = true;
        } else {
            if (!scan.skip_past(end))
                scan.refuse(format("section %s has no end: close it with %s",
                                   quote(section).c_str(), quote(end).c_str()),
                            place);
            continue;
        }
        scan.expect(end);
    }
    return file.raw.finish();
}

} // namespace ode::soft
