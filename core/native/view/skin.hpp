// What is seen of a mesh of which some hexes are kept; on one thread, because a window's thread asks.
#pragma once

#include <tuple>

#include "mesh/array_views.hpp"

namespace hexmend {

using HexMask = std::span<const bool>;

using Neighbours = ArrayView<const Node, 6>;

// Nodes that faces use, faces as places among them, and the hex of each face.
using Faces = std::tuple<OwnedArray<Node>, OwnedArray<Node, 4>, OwnedArray<Node>>;

Faces visible(std::int64_t nodes, Hexes hexes, Neighbours neighbours, HexMask keep);

Faces faces_of(Hexes hexes, Neighbours neighbours, HexMask keep, HexMask chosen, bool hidden);

void outer(Neighbours neighbours, HexMask keep, std::span<bool> answer);

void shrunk(Points points, Indices nodes, double shrink, std::span<Point> places);

void edges_kept(Hexes hexes, Indices start, Indices corners, ArrayView<const Node, 2> edges, HexMask keep,
                std::span<bool> answer);

}  // namespace hexmend
