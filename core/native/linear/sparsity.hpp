// Sparsity of a Hessian: the 3 x 3 blocks above its diagonal, one for each pair of free nodes that share a hex.
#pragma once

#include <tuple>

#include "mesh/array_views.hpp"

namespace hexmend {

// Pairs of corners of a hex, in the order 01, 02... 07, 12...
constexpr int PAIRS = 28;

// Number of the pair of corners a < b.
constexpr int pair_of(int a, int b) { return a * (15 - a) / 2 + b - a - 1; }

// Block rows row_start (k + 1,) and columns, ascending within a row; and target (m, 28), the block of each pair of a
// hex's corners: -1 if a corner is fixed, -2 - slot if both are one node. slots (m, 8) is the slot of each corner, -1
// if it is fixed; nodes (k,) the node of each slot. Throws std::overflow_error if there are more than `max_items`
// blocks.
std::tuple<OwnedArray<std::int32_t>, OwnedArray<std::int32_t>, OwnedArray<std::int32_t, PAIRS>> pattern(
    Hexes slots, Indices nodes, Indices start, Indices corners, std::int64_t max_items);

}  // namespace hexmend
