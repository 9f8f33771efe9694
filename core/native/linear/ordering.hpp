// Ordering of the free nodes in an assembled Hessian: neighbours close to each other, in parts that share no hex; each
// two consecutive parts have a separator, and all separators follow the parts.
#pragma once

#include <utility>

#include "mesh/array_views.hpp"

namespace hexmend {

// The node in each slot (k,), and the bounds (2 parts,) of the parts and then the separators. ring_start and ring are
// `node_rings`, free (n,). The number of parts is reduced until none is too thin.
std::pair<OwnedArray<std::int32_t>, OwnedArray<std::int32_t>> slots(Hexes hexes, Indices ring_start, Indices ring,
                                                                    std::span<const bool> free, int parts);

}  // namespace hexmend
