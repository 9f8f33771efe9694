// Which free nodes share a hex: the pattern of a Hessian's 3 x 3 blocks above its diagonal, as compressed rows.
#pragma once

#include "rows.hpp"

namespace hexmend {

// Pairs of corners of a hex, in the order 01, 02... 07, 12...
constexpr int PAIRS = 28;

std::pair<Made<std::int32_t>, Made<std::int32_t>> rows(Hexes slots, Indices nodes, Indices start, Indices corners);

void targets(Hexes slots, Indices row_start, Indices columns, std::span<std::array<std::int32_t, PAIRS>> target);

}  // namespace hexmend
