#pragma once

#include "mesh/scan.h"
#include "mesh/tet_mesh.h"

#include <array>
#include <limits>
#include <map>
#include <span>

namespace ode::soft {

/// What a reader collects: nodes and tetrahedra by the numbers that the file gives them, with the
/// places they stand at. finish() turns it into a mesh or refuses it whole.
class RawMesh {
public:
    /// A group of an element that belongs to none.
    static constexpr std::int64_t kNoGroup = std::numeric_limits<std::int64_t>::min();

    /// Places of nodes and elements are told by these, which are borrowed; one file has one.
    RawMesh(const Scan& nodes, const Scan& elements) : node_scan_(nodes), element_scan_(elements) {}

    void add_node(std::int64_t number, const Vec3& x, std::size_t place);
    /// @param node  4 or 10 numbers, mid-edge nodes in the order of kTetEdge
    /// @throws InputError when linear and quadratic elements mix
    void add_element(std::int64_t number, std::span<const std::int64_t> node, std::int64_t group,
                     std::size_t place);
    void name_group(std::int64_t group, std::string name) { group_name_[group] = std::move(name); }
    bool has_elements() const noexcept { return !element_.empty(); }

    /// Puts nodes in the order of their numbers, drops those that no tetrahedron uses, turns a mesh
    /// whose elements are all inverted, and checks the result. Call once, at the end.
    /// @throws InputError
    TetMesh finish();

private:
    struct Node {
        std::int64_t number;
        std::size_t place;
        Vec3 x;
    };
    struct Element {
        std::int64_t number;
        std::int64_t group;
        std::size_t place;
    };

    std::vector<int> resolve() const;
    void set_groups(TetMesh& mesh) const;
    [[noreturn]] void refuse(std::size_t element, const std::string& what) const;

    const Scan& node_scan_;
    const Scan& element_scan_;
    int order_ = 0; // 0: no element yet
    std::vector<Node> node_;
    std::vector<Element> element_;
    std::vector<std::int64_t> corner_; // node numbers, 4 or 10 an element
    std::map<std::int64_t, std::string> group_name_;
};

/// Refuses an element kind that no solid of tetrahedra can hold. @param kind  "a hexahedron"
[[noreturn]] void refuse_kind(const Scan& scan, std::size_t place, std::int64_t number,
                              const char* kind);

} // namespace ode::soft
