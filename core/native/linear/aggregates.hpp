// Aggregates of slots: the unknowns of a coarse space, in which the nodes of an aggregate move together.
#pragma once

#include <tuple>

#include "mesh/array_views.hpp"

namespace hexmend {

// Pattern of A R, R being the translations of aggregates: the aggregate of each slot (k,), and the aggregates that each
// row meets, as compressed rows that ascend, row_start (k + 1,) and columns.
struct CoarsePattern {
    Indices aggregate, row_start, columns;

    void check() const {
        expect(aggregate.size() + 1 == row_start.size(), "row_start: one more than aggregates is expected");
        expect(are_csr(row_start, columns.size()), "columns: as many as the last of row_start are expected");
    }
};

// Divide slots into aggregates, and find the pattern of A R: arrays of a `CoarsePattern`.
//
// A slot is a centre if no centre before it is within `distance` edges. Each slot belongs to the nearest centre, of
// several to the first; aggregates are numbered as their centres are. Ways through fixed nodes do not count. slots (m,
// 8): the slot of each corner, -1 if it is fixed; slot_of_node (n,); nodes (k,); ring_start, ring: neighbours of nodes
// along edges; start, corners: corners of hexes at each node.
std::tuple<IntArray, IntArray, IntArray> coarse_pattern(Hexes slots, Indices slot_of_node, Indices nodes,
                                                        Indices ring_start, Indices ring, Indices start,
                                                        Indices corners, int distance);

}  // namespace hexmend
