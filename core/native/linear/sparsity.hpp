// Which free nodes share a hex: the pattern of a Hessian's 3 x 3 blocks above its diagonal, as compressed rows.
#pragma once

#include <tuple>

#include "mesh/array_views.hpp"

namespace hexmend {

// Pairs of corners of a hex, in the order 01, 02... 07, 12...
constexpr int PAIRS = 28;

// Number of the pair of two corners, the lower one first.
constexpr int pair_of(int a, int b) { return a * (15 - a) / 2 + b - a - 1; }

std::tuple<OwnedArray<std::int32_t>, OwnedArray<std::int32_t>, OwnedArray<std::int32_t, PAIRS>> pattern(
    Hexes slots, Indices nodes, Indices start, Indices corners, std::int64_t most);

}  // namespace hexmend
