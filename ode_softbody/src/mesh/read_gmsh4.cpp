#include "mesh/gmsh.h"

#include "base/error.h"

#include <cstdlib>

namespace ode::soft {

// Only the physical groups of volumes matter; a group's sign is its orientation.
void read_gmsh4_entities(GmshFile& file) {
    using Tag = std::int32_t;
    using Size = std::uint64_t;
    std::size_t count[4];
    for (std::size_t& c : count)
        c = file.count<Size>("a number of entities", 8, 20);
    for (int dimension = 0; dimension < 4; ++dimension) {
        for (std::size_t i = 0; i < count[dimension]; ++i) {
            const std::int64_t tag = file.integer<Tag>("an entity's tag");
            for (int c = 0; c < (dimension == 0 ? 3 : 6); ++c)
                file.real("an entity's bounds");
            const std::size_t groups = file.count<Size>("a number of physical groups", 2, 4);
            for (std::size_t g = 0; g < groups; ++g) {
                const std::int64_t group = file.integer<Tag>("a physical group");
                if (dimension == 3 && g == 0)
                    file.volume_group[tag] =
                        group < 0 && group != RawMesh::kNoGroup ? -group : group;
            }
            if (dimension == 0)
                continue;
            const std::size_t bounding = file.count<Size>("a number of bounding entities", 2, 4);
            for (std::size_t b = 0; b < bounding; ++b)
                file.integer<Tag>("a bounding entity");
        }
    }
}

// blocks nodes least greatest; each block: dimension entity parametric nodes, the numbers of all
// its nodes, then their coordinates, with one more for each dimension of a parametric entity.
void read_gmsh4_nodes(GmshFile& file) {
    using Size = std::uint64_t;
    Scan& scan = file.scan;
    const std::size_t blocks = file.count<Size>("the number of node blocks", 8, 20);
    const std::size_t total = file.count<Size>("the number of nodes", 8, 32);
    file.integer<Size>("the least node number");
    file.integer<Size>("the greatest node number");
    std::vector<std::int64_t> number;
    std::size_t read = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
        const std::int64_t dimension = file.integer<std::int32_t>("a block's dimension");
        if (dimension < 0 || dimension > 3)
            scan.refuse(format("a node block has dimension %lld: give 0 to 3",
                               static_cast<long long>(dimension)));
        file.integer<std::int32_t>("a block's entity");
        const std::int64_t parametric = file.integer<std::int32_t>("a block's parametric flag");
        const std::size_t nodes = file.count<Size>("a block's number of nodes", 8, 32);
        if (nodes > total - read)
            scan.refuse(
                format("node blocks hold more than the %zu nodes of the header: correct the "
                       "counts",
                       total));
        number.clear();
        for (std::size_t i = 0; i < nodes; ++i)
            number.push_back(file.integer<Size>("a node's number"));
        for (std::size_t i = 0; i < nodes; ++i) {
            const std::size_t place = scan.place();
            Vec3 x;
            for (double& c : x)
                c = file.real("a coordinate");
            for (std::int64_t p = 0; parametric != 0 && p < dimension; ++p)
                file.real("a parametric coordinate");
            file.raw.add_node(number[i], x, place);
        }
        read += nodes;
    }
    if (read != total)
        scan.refuse(
            format("node blocks hold %zu nodes, the header promises %zu: correct the counts", read,
                   total));
}

// blocks elements least greatest; each block: dimension entity type elements, then (number nodes).
void read_gmsh4_elements(GmshFile& file) {
    using Size = std::uint64_t;
    Scan& scan = file.scan;
    const std::size_t blocks = file.count<Size>("the number of element blocks", 8, 20);
    const std::size_t total = file.count<Size>("the number of elements", 4, 16);
    file.integer<Size>("the least element number");
    file.integer<Size>("the greatest element number");
    std::int64_t node[27];
    std::size_t read = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
        const std::int64_t dimension = file.integer<std::int32_t>("a block's dimension");
        const std::int64_t entity = file.integer<std::int32_t>("a block's entity");
        const std::size_t type_place = scan.place();
        const std::int64_t type = file.integer<std::int32_t>("a block's element type");
        const std::size_t elements = file.count<Size>("a block's number of elements", 4, 16);
        if (elements > total - read)
            scan.refuse(format("element blocks hold more than the %zu elements of the header: "
                               "correct the counts",
                               total));
        auto group = RawMesh::kNoGroup;
        if (const auto found = file.volume_group.find(entity);
            dimension == 3 && found != file.volume_group.end())
            group = found->second;
        for (std::size_t i = 0; i < elements; ++i) {
            const std::size_t place = scan.place();
            const std::int64_t number = file.integer<Size>("an element's number");
            const int nodes = file.nodes_of_type(type, number, i == 0 ? type_place : place);
            for (int n = 0; n < nodes; ++n)
                node[n] = file.integer<Size>("an element's node");
            file.add_element(type, number, {node, static_cast<std::size_t>(nodes)}, group, place);
        }
        read += elements;
    }
    if (read != total)
        scan.refuse(format("element blocks hold %zu elements, the header promises %zu: correct the "
                           "counts",
                           read, total));
}

} // namespace ode::soft
