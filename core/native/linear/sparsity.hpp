// Sparsity of a Hessian: the 3 x 3 blocks above its diagonal, one for each pair of free nodes that share a hex.
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

// Pairs of corners of a hex, in the order 01, 02... 07, 12...
constexpr int PAIRS = 28;

// Number of the pair of corners a < b.
constexpr int pair_of(int a, int b) { return a * (15 - a) / 2 + b - a - 1; }

// Block rows row_start (k + 1,) and columns, ascending in each row. Without `opposite`, two nodes that are opposite
// corners wherever they share a hex have no block: no corner tetrahedron has both. Throws std::overflow_error if there
// are more than `max_items` blocks.
CSR pattern(Hexes slots, Indices nodes, Indices start, Indices corners, bool opposite, std::int64_t max_items);

// Order the free nodes so that neighbours are close to each other, in parts that share no hex; each two consecutive
// parts have a separator, and all separators follow the parts. Returns the node in each slot, and the bounds (2
// parts,).
CSR slots(Hexes hexes, Indices ring_start, Indices ring, std::span<const bool> free, int parts);

}  // namespace hexmend
