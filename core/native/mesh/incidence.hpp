// Who touches whom: nodes and hexes, faces, edges, colours. All linear in the number of hexes.
//
// Corners of hexes are numbers 8 * hex + corner; rows of different lengths are two arrays, row i being
// items[start[i]] to items[start[i + 1] - 1].
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

using CSR = std::pair<OwnedArray<std::int32_t>, OwnedArray<std::int32_t>>;

CSR node_corners(Hexes hexes, std::int64_t nodes);

std::pair<OwnedArray<std::int32_t, 6>, std::int64_t> face_neighbours(Hexes hexes, Indices start, Indices corners);

std::int64_t components(Hexes hexes, std::span<const bool> used);

CSR node_rings(Hexes hexes, Indices start, Indices corners, std::int64_t most);

OwnedArray<std::int32_t> greedy_colours(Indices start, Indices corners, std::span<const bool> chosen);

CSR grouped(Indices colour, std::int64_t count);

OwnedArray<std::int32_t> layers(std::span<const std::array<std::int32_t, 6>> neighbours);

OwnedArray<bool> around(Hexes hexes, Indices start, Indices corners, Indices chosen, int rings);

}  // namespace hexmend
