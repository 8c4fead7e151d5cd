#include "mesh/gmsh.h"

#include "base/error.h"

namespace ode::soft {

// In a binary file the count stands in text, and the data begin behind the end of its line.
static std::size_t read_count(GmshFile& file, const char* what, std::size_t text,
                              std::size_t binary) {
    const std::size_t count = file.scan.count(what, file.binary ? binary : text);
    if (file.binary)
        file.scan.line();
    return count;
}

void read_gmsh2_nodes(GmshFile& file) {
    const std::size_t nodes = read_count(file, "the number of nodes", 8, 28);
    for (std::size_t i = 0; i < nodes; ++i) {
        const std::size_t place = file.scan.place();
        const std::int64_t number = file.integer<std::int32_t>("a node's number");
        Vec3 x;
        for (double& c : x)
            c = file.real("a coordinate");
        file.raw.add_node(number, x, place);
    }
}

// number type tag_count tags nodes; in binary a header (type, elements that follow, tag_count)
// before a run of (number tags nodes). The first tag is the physical group, 0 for none.
void read_gmsh2_elements(GmshFile& file) {
    Scan& scan = file.scan;
    const std::size_t elements = read_count(file, "the number of elements", 8, 8);
    std::int64_t type = 0, tags = 0, follow = 0;
    std::int64_t node[27];
    for (std::size_t i = 0; i < elements; ++i) {
        std::size_t place = scan.place();
        std::int64_t number = 0;
        if (!file.binary) {
            number = scan.integer("an element's number");
            type = scan.integer("an element's type");
            tags = static_cast<std::int64_t>(scan.count("an element's number of tags", 2));
        } else {
            if (follow == 0) {
                type = scan.binary<std::int32_t>("an element type");
                follow = scan.binary<std::int32_t>("a number of elements");
                tags = scan.binary<std::int32_t>("a number of tags");
                if (follow < 1 || static_cast<std::size_t>(follow) > elements - i)
                    scan.refuse(
                        format("a run of %lld elements stands where %zu are due: correct the "
                               "counts",
                               static_cast<long long>(follow), elements - i),
                        place);
                scan.check_count(tags, "a number of tags", 4, place);
                place = scan.place();
            }
            --follow;
            number = scan.binary<std::int32_t>("an element's number");
        }
        const int nodes = file.nodes_of_type(type, number, place);
        std::int64_t group = 0;
        for (std::int64_t t = 0; t < tags; ++t) {
            const std::int64_t tag = file.integer<std::int32_t>("an element's tag");
            if (t == 0)
                group = tag;
        }
        for (int n = 0; n < nodes; ++n)
            node[n] = file.integer<std::int32_t>("an element's node");
        file.add_element(type, number, {node, static_cast<std::size_t>(nodes)},
                         group == 0 ? RawMesh::kNoGroup : group, place);
    }
}

} // namespace ode::soft
