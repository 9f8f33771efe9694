// What is seen of a mesh of which some hexes are kept; on one thread, because a window's thread asks.
#pragma once

#include <tuple>

#include "mesh/array_views.hpp"

namespace hexmend {

using Kept = std::span<const bool>;

using Neighbours = Rows<const Node, 6>;

// Nodes that faces use, faces as places among them, and the hex of each face.
using Faces = std::tuple<Made<Node>, Made<Node, 4>, Made<Node>>;

Faces visible(std::int64_t nodes, Hexes hexes, Neighbours neighbours, Kept keep);

Faces faces_of(Hexes hexes, Neighbours neighbours, Kept keep, Kept chosen, bool hidden);

void outer(Neighbours neighbours, Kept keep, std::span<bool> answer);

void shrunk(Points points, Indices nodes, double shrink, std::span<Point> places);

void edges_kept(Hexes hexes, Indices start, Indices corners, Rows<const Node, 2> edges, Kept keep,
                std::span<bool> answer);

}  // namespace hexmend
