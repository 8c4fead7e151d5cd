#include "base/error.h"
#include "mesh/raw_mesh.h"
#include "mesh/read.h"

namespace ode::soft {

namespace {

const char* refused_kind(std::string_view keyword) {
    if (keyword.starts_with("Hexahedra"))
        return "a hexahedron";
    if (keyword.starts_with("Prisms"))
        return "a prism";
    if (keyword.starts_with("Pyramids"))
        return "a pyramid";
    if (keyword.starts_with("TetrahedraP") && keyword != "TetrahedraP2")
        return keyword == "TetrahedraP2Ordering"
                   ? "a quadratic tetrahedron with an order of nodes of its own"
                   : "a tetrahedron of more than 10 nodes";
    return nullptr;
}

bool starts_keyword(std::string_view word) {
    const char c = word.empty() ? 'a' : word.front();
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

void read_vertices(Scan& scan, RawMesh& raw) {
    const std::size_t nodes = scan.count("the number of vertices", 8);
    for (std::size_t i = 0; i < nodes; ++i) {
        const std::size_t place = scan.place();
        Vec3 x;
        for (double& c : x)
            c = scan.real("a coordinate");
        scan.real("a vertex reference");
        raw.add_node(static_cast<std::int64_t>(i) + 1, x, place);
    }
}

// Mid-edge nodes of TetrahedraP2 come in the order of kTetEdge.
void read_tetrahedra(Scan& scan, RawMesh& raw, std::size_t nodes, std::int64_t& number) {
    const std::size_t elements = scan.count("the number of tetrahedra", 10);
    std::int64_t node[10];
    for (std::size_t i = 0; i < elements; ++i) {
        const std::size_t place = scan.place();
        for (std::size_t n = 0; n < nodes; ++n)
            node[n] = scan.integer("an element's node");
        const std::int64_t reference = scan.integer("an element's reference");
        raw.add_element(++number, {node, nodes}, reference, place);
    }
}

} // namespace

TetMesh read_medit(std::string_view bytes, const std::string& name) {
    Scan scan(bytes, name);
    scan.set_comment('#');
    RawMesh raw(scan, scan);
    scan.expect("MeshVersionFormatted");
    scan.integer("the version");
    std::int64_t number = 0;
    bool vertices = false;
    for (std::string_view word = scan.word(); !word.empty() && word != "End"; word = scan.word()) {
        if (!starts_keyword(word))
            scan.refuse(format("%s stands where a keyword is due: correct the count of the list "
                               "before it",
                               quote(word).c_str()));
        if (word == "Dimension") {
            const std::int64_t dimension = scan.integer("the dimension");
            if (dimension != 3)
                scan.refuse(
                    format("the dimension is %lld: give 3", static_cast<long long>(dimension)));
        } else if (word == "Vertices") {
            if (vertices)
                scan.refuse("the vertices are listed a second time: keep one list");
            vertices = true;
            read_vertices(scan, raw);
        } else if (word == "Tetrahedra" || word == "TetrahedraP2") {
            read_tetrahedra(scan, raw, word == "Tetrahedra" ? 4 : 10, number);
        } else {
            const char* kind = refused_kind(word);
            const std::size_t place = scan.place();
            if (kind != nullptr && scan.peek() != "0")
                refuse_kind(scan, place, number + 1, kind);
            while (!starts_keyword(scan.peek()))
                scan.word(); // a list of no concern, say Triangles or Ridges
        }
    }
    return raw.finish();
}

} // namespace ode::soft
