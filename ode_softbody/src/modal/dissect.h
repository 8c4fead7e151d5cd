#pragma once

#include "modal/block_system.h"

namespace ode::soft {

/// An elimination order with its tree: pieces of the body, each a run of consecutive positions, and
/// after two pieces the nodes that separate them (nested dissection; George 1973,
/// doi:10.1137/0710032).
struct Dissection {
    struct Piece {
        int first;  ///< positions [first, last) of the order
        int last;   ///< may equal first: two pieces that nothing joins
        int parent; ///< index of the piece that follows its children; -1 for the root
    };
    std::vector<int> order;   ///< order[position] = node
    std::vector<Piece> piece; ///< children before parents
};

/// Cuts the node graph where it is thinnest across its longer principal axes. The cut plane runs
/// through the median node; the separator is a minimum vertex cover of the edges it cuts (Koenig's
/// theorem), so on quadratic and cubic elements it follows element faces. Geometry gives cuts of
/// the quality of a graph partitioner on the compact or thin solids of this library without another
/// dependency. Deterministic.
Dissection dissect(const BlockSystem& system);

} // namespace ode::soft
