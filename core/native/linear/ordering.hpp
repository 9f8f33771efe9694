// In what order an assembled Hessian keeps the free nodes: neighbours near each other, in parts that share no hex, each
// two of them with a separator between them, and the separators behind the parts.
#pragma once

#include <utility>

#include "mesh/array_views.hpp"

namespace hexmend {

std::pair<OwnedArray<std::int32_t>, OwnedArray<std::int32_t>> slots(Hexes hexes, Indices ring_start, Indices ring,
                                                                    std::span<const bool> free, int parts);

}  // namespace hexmend
