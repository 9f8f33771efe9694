// How many hexes meet in an edge: what tells where the blocks of a mesh join.
#pragma once

#include <tuple>

#include "mesh/array_views.hpp"

namespace hexmend {

std::tuple<OwnedArray<Node, 2>, OwnedArray<std::int32_t>, OwnedArray<bool>> edges(
    Hexes hexes, Indices start, Indices corners, std::span<const std::array<std::int32_t, 6>> neighbours,
    std::int64_t most);

}  // namespace hexmend
