#include "mesh/raw_mesh.h"

#include "base/error.h"
#include "mesh/quality.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace ode::soft {

namespace {

long long printable(std::int64_t number) { return static_cast<long long>(number); }

// Some programs count corners the other way round. Swapping corners 1 and 2 mirrors an element; the
// mid-edge nodes follow their edges: 01 <-> 02, 13 <-> 23.
void turn_if_all_inverted(TetMesh& mesh) {
    for (std::size_t e = 0; e < mesh.element_count(); ++e)
        if (!(element_quality(mesh, e) < 0.0))
            return;
    const auto per = static_cast<std::size_t>(mesh.nodes_per_element());
    for (std::size_t at = 0; at < mesh.element.size(); at += per) {
        std::swap(mesh.element[at + 1], mesh.element[at + 2]);
        if (mesh.order == 2) {
            std::swap(mesh.element[at + 4], mesh.element[at + 6]);
            std::swap(mesh.element[at + 8], mesh.element[at + 9]);
        }
    }
}

} // namespace

void RawMesh::add_node(std::int64_t number, const Vec3& x, std::size_t place) {
    node_.push_back({number, place, x});
}

void RawMesh::add_element(std::int64_t number, std::span<const std::int64_t> node,
                          std::int64_t group, std::size_t place) {
    const int order = node.size() == 4 ? 1 : 2;
    if (order_ != 0 && order != order_)
        element_scan_.refuse(
            format(
                "element %lld has %zu nodes, those before it %d: save all elements linear or all "
                "quadratic",
                printable(number), node.size(), order_ == 1 ? 4 : 10),
            place);
    order_ = order;
    element_.push_back({number, group, place});
    corner_.insert(corner_.end(), node.begin(), node.end());
}

void RawMesh::refuse(std::size_t element, const std::string& what) const {
    const Element& e = element_[element];
    element_scan_.refuse(format("element %lld %s", printable(e.number), what.c_str()), e.place);
}

// Positions in node_, sorted by number, of the nodes of all elements.
std::vector<int> RawMesh::resolve() const {
    const auto per = corner_.size() / element_.size();
    std::vector<int> out;
    out.reserve(corner_.size());
    for (std::size_t i = 0; i < corner_.size(); ++i) {
        // Numbers without gaps are found at once.
        const std::int64_t number = corner_[i];
        const auto guess =
            static_cast<std::uint64_t>(number) - static_cast<std::uint64_t>(node_.front().number);
        std::size_t at = 0;
        if (guess < node_.size() && node_[guess].number == number) {
            at = guess;
        } else {
            const auto found = std::lower_bound(
                node_.begin(), node_.end(), number,
                [](const Node& n, std::int64_t value) { return n.number < value; });
            if (found == node_.end() || found->number != number)
                refuse(i / per, format("uses node %lld, which the file does not define: use the "
                                       "nodes %lld to %lld that it does",
                                       printable(number), printable(node_.front().number),
                                       printable(node_.back().number)));
            at = static_cast<std::size_t>(found - node_.begin());
        }
        out.push_back(static_cast<int>(at));
    }
    return out;
}

void RawMesh::set_groups(TetMesh& mesh) const {
    std::map<std::int64_t, int> index;
    for (const Element& e : element_)
        index.emplace(e.group, 0);
    const bool named = std::any_of(index.begin(), index.end(), [&](const auto& entry) {
        return group_name_.contains(entry.first);
    });
    if (index.size() == 1 && !named)
        return; // one solid, whatever its number
    for (auto& [group, position] : index) {
        position = static_cast<int>(mesh.group_name.size());
        const auto name = group_name_.find(group);
        mesh.group_name.push_back(name != group_name_.end() ? name->second
                                  : group == kNoGroup       ? "none"
                                                            : std::to_string(group));
    }
    mesh.group.reserve(element_.size());
    for (const Element& e : element_)
        mesh.group.push_back(index[e.group]);
}

TetMesh RawMesh::finish() {
    if (element_.empty())
        element_scan_.refuse("the file holds no tetrahedra: export the volume mesh, not only its "
                             "surface",
                             0);
    constexpr auto kMost = static_cast<std::size_t>(std::numeric_limits<int>::max());
    if (node_.empty() || node_.size() > kMost || element_.size() > kMost / 10)
        node_scan_.refuse(format("the file holds %zu nodes and %zu tetrahedra: give between 4 and "
                                 "2^31 nodes",
                                 node_.size(), element_.size()),
                          0);

    std::stable_sort(node_.begin(), node_.end(),
                     [](const Node& a, const Node& b) { return a.number < b.number; });
    for (std::size_t i = 1; i < node_.size(); ++i)
        if (node_[i].number == node_[i - 1].number)
            node_scan_.refuse(
                format("node %lld is defined twice: give each node a number of its own",
                       printable(node_[i].number)),
                node_[i].place);

    TetMesh mesh;
    mesh.order = order_;
    mesh.element = resolve();
    std::vector<int> position(node_.size(), -1);
    for (const int n : mesh.element)
        position[static_cast<std::size_t>(n)] = 0;
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < node_.size(); ++i) {
        if (position[i] < 0)
            continue;
        position[i] = static_cast<int>(mesh.node.size());
        mesh.node.push_back(node_[i].x);
        kept.push_back(i);
    }
    for (int& n : mesh.element)
        n = position[static_cast<std::size_t>(n)];
    set_groups(mesh);
    turn_if_all_inverted(mesh);

    if (const auto fault = find_fault(mesh)) {
        if (fault->element != MeshFault::kNone)
            refuse(fault->element, fault->text);
        if (fault->node != MeshFault::kNone) {
            const Node& n = node_[kept[fault->node]];
            node_scan_.refuse(format("node %lld %s", printable(n.number), fault->text.c_str()),
                              n.place);
        }
        element_scan_.refuse("the mesh " + fault->text, 0);
    }
    return mesh;
}

void refuse_kind(const Scan& scan, std::size_t place, std::int64_t number, const char* kind) {
    scan.refuse(format("element %lld is %s: save the volume as tetrahedra of 4 or 10 nodes",
                       printable(number), kind),
                place);
}

} // namespace ode::soft
