// Visible faces of a mesh of which some hexes, keep (m,), are shown. The functions run on one thread, because the
// window's thread calls them.
#pragma once

#include <tuple>

#include "mesh/array_views.hpp"

namespace hexmend {

using HexMask = std::span<const bool>;

using Neighbours = ArrayView<const Node, 6>;

// Nodes of faces (u,), the faces as positions among these (k, 4), and the hex of each face (k,).
using Faces = std::tuple<OwnedArray<Node>, OwnedArray<Node, 4>, OwnedArray<Node>>;

// Faces of shown hexes behind which no hex is shown. nodes is the number of nodes of the mesh.
Faces visible(std::int64_t nodes, Hexes hexes, Neighbours neighbours, HexMask keep);

// Faces of the chosen hexes, each with its own eight nodes; without `hidden` only those behind which no hex is shown.
Faces faces_of(Hexes hexes, Neighbours neighbours, HexMask keep, HexMask chosen, bool hidden);

// Write answer (m,): whether a hex is shown and has a visible face.
void outer(Neighbours neighbours, HexMask keep, std::span<bool> answer);

// Write places (8 k, 3): the corners of hexes, nodes (8 k,), moved by the fraction `shrink` towards their mean.
void shrunk(Points points, Indices nodes, double shrink, std::span<Point> places);

// Write answer (k,): whether a shown hex has each of the edges (k, 2).
void edges_kept(Hexes hexes, Indices start, Indices corners, ArrayView<const Node, 2> edges, HexMask keep,
                std::span<bool> answer);

}  // namespace hexmend
