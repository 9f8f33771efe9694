// Valence of edges, from which the block structure of a mesh follows.
#pragma once

#include <tuple>

#include "mesh/array_views.hpp"

namespace hexmend {

// Every edge once: its nodes, the lower first, (e, 2) ascending; the number of hexes around it, (e,); whether it is on
// the boundary, (e,). start, corners and neighbours are those of incidence.hpp. Throws std::overflow_error if there are
// more than `max_items` edges.
std::tuple<OwnedArray<Node, 2>, OwnedArray<std::int32_t>, OwnedArray<bool>> edges(
    Hexes hexes, Indices start, Indices corners, std::span<const std::array<std::int32_t, 6>> neighbours,
    std::int64_t max_items);

}  // namespace hexmend
