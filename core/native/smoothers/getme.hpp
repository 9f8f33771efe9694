// Simultaneous GETMe: a node moves to the weighted mean of the targets that its hexes' element steps give it.
//
// Vartziotis and Wipper 2011, CMAME 200:1186; thesis 3.1.2.
#pragma once

#include "mesh/hex_mesh.hpp"

namespace hexmend {

// Write targets (n, 3): for each of `nodes`, the mean of its targets `places` (m, 8, 3) over its hexes, by their
// weights (m,).
void weighted_means(std::span<const std::array<double, 24>> places, Numbers weights, const HexMesh &mesh, Indices nodes,
                    std::span<Point> targets);

// Shorten moves until no hex that was sound is inverted; returns the number of shortened moves.
//
// points (n, 3) are the positions before the move, moved (n, 3) those after it, which are changed; sound (m,) tells
// which hexes were sound before; harmed (k,) are hexes that were and no longer are. In each round the nodes of inverted
// hexes halve their moves; the fourth halving gives the move up.
std::int64_t relax(Points points, const HexMesh &mesh, std::span<const bool> sound, Indices harmed,
                   std::span<Point> moved);

}  // namespace hexmend
