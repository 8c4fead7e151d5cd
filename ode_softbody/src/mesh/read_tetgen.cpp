#include "base/error.h"
#include "mesh/raw_mesh.h"
#include "mesh/read.h"

#include <unordered_map>

namespace ode::soft {

namespace {

// A header line of whole numbers, of which the last ones may be missing.
template <std::size_t N>
void read_header(Scan& scan, std::int64_t (&value)[N]) {
    value[0] = scan.integer("the first number of the header");
    for (std::size_t i = 1; i < N && scan.has_word_on_line(); ++i)
        value[i] = scan.integer("a number of the header");
}

std::unordered_map<std::int64_t, Vec3> read_nodes(Scan& scan, RawMesh& raw) {
    std::int64_t header[4] = {0, 3, 0, 0}; // nodes, dimension, attributes, boundary markers
    const std::size_t header_place = scan.place();
    read_header(scan, header);
    const std::size_t nodes = scan.check_count(header[0], "the number of nodes", 7, header_place);
    if (header[1] != 3)
        scan.refuse(format("the dimension is %lld: give 3", static_cast<long long>(header[1])),
                    header_place);
    const std::size_t extra =
        scan.check_count(header[2], "the number of attributes", 1, header_place) +
        scan.check_count(header[3], "the number of boundary markers", 1, header_place);
    std::unordered_map<std::int64_t, Vec3> position;
    for (std::size_t i = 0; i < nodes; ++i) {
        const std::size_t place = scan.place();
        const std::int64_t number = scan.integer("a node's number");
        Vec3 x;
        for (double& c : x)
            c = scan.real("a coordinate");
        for (std::size_t a = 0; a < extra; ++a)
            scan.real("a node's attribute");
        raw.add_node(number, x, place);
        position.emplace(number, x);
    }
    return position;
}

// Puts the mid-edge nodes of a 10-node element in the order of kTetEdge: each edge takes the node
// nearest to its midpoint, and no node may be taken twice.
void order_mid_nodes(std::int64_t (&node)[10],
                     const std::unordered_map<std::int64_t, Vec3>& position, const Scan& scan,
                     std::size_t place) {
    Vec3 x[10];
    for (std::size_t i = 0; i < 10; ++i) {
        const auto found = position.find(node[i]);
        if (found == position.end())
            return; // finish() says which node is missing
        x[i] = found->second;
    }
    std::int64_t ordered[6];
    bool taken[6] = {};
    for (std::size_t e = 0; e < 6; ++e) {
        const Vec3 mid = 0.5 * (x[kTetEdge[e][0]] + x[kTetEdge[e][1]]);
        std::size_t nearest = 0;
        for (std::size_t i = 1; i < 6; ++i)
            if ((x[4 + i] - mid).squaredNorm() < (x[4 + nearest] - mid).squaredNorm())
                nearest = i;
        if (taken[nearest])
            scan.refuse(format("node %lld is nearest to the middle of two edges of its element: "
                               "place the mid-edge nodes in the middle of their edges",
                               static_cast<long long>(node[4 + nearest])),
                        place);
        taken[nearest] = true;
        ordered[e] = node[4 + nearest];
    }
    std::copy(std::begin(ordered), std::end(ordered), node + 4);
}

} // namespace

TetMesh read_tetgen(std::string_view node_bytes, const std::string& node_name,
                    std::string_view element_bytes, const std::string& element_name) {
    Scan node_scan(node_bytes, node_name), scan(element_bytes, element_name);
    node_scan.set_comment('#');
    scan.set_comment('#');
    RawMesh raw(node_scan, scan);
    const auto position = read_nodes(node_scan, raw);

    std::int64_t header[3] = {0, 4, 0}; // elements, nodes an element, attributes
    const std::size_t header_place = scan.place();
    read_header(scan, header);
    const std::size_t elements =
        scan.check_count(header[0], "the number of elements", 9, header_place);
    if (header[1] != 4 && header[1] != 10)
        scan.refuse(
            format("elements have %lld nodes: give 4 or 10", static_cast<long long>(header[1])),
            header_place);
    const std::size_t attributes =
        scan.check_count(header[2], "the number of attributes", 1, header_place);
    std::int64_t node[10];
    for (std::size_t i = 0; i < elements; ++i) {
        const std::size_t place = scan.place();
        const std::int64_t number = scan.integer("an element's number");
        for (std::int64_t n = 0; n < header[1]; ++n)
            node[n] = scan.integer("an element's node");
        std::int64_t group = RawMesh::kNoGroup;
        for (std::size_t a = 0; a < attributes; ++a) {
            const double value = scan.real("an element's attribute");
            // Regions are whole numbers; TetGen may print them as 1.0 and -1e0.
            if (a == 0 && value > -1e15 && value < 1e15)
                group = static_cast<std::int64_t>(value);
        }
        if (header[1] == 10)
            order_mid_nodes(node, position, scan, place);
        raw.add_element(number, {node, static_cast<std::size_t>(header[1])}, group, place);
    }
    return raw.finish();
}

} // namespace ode::soft
