// Meshes that are uniform refinements: each hex of a coarser mesh is divided into 2 x 2 x 2.
#pragma once

#include "mesh/hex_mesh.hpp"

namespace hexmend {

// Nodes of a coarse hex: node (x, y, z) of its 3 x 3 x 3 lattice is at 9 z + 3 y + x.
using Block = std::array<Node, 27>;

// Nodes of each coarse hex, whose axes are those of the first of its hexes, in the order of these; no row where the
// mesh is not a refinement.
OwnedArray<Node, 27> coarse_blocks(Hexes hexes, Indices start, Indices corners);

// Transfinite interpolation of values within each coarse hex: from those at its corners, and at nodes that are kept, to
// all others. The mean of two ends on an edge; half the sum over its edges less a quarter of that over its corners on a
// face; with the faces, half of their sum less a quarter of the edges' plus an eighth of the corners' in the middle.
void interpolate_blocks(ArrayView<const Node, 27> blocks, std::span<const bool> kept, std::span<Point> values);

}  // namespace hexmend
