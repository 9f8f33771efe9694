// Simultaneous GETMe: Vartziotis and Wipper 2011, CMAME 200:1186; thesis 3.1.2.
#pragma once

#include "mesh/hex_mesh.hpp"

namespace hexmend {

// Write the targets of the corners of every hex by its element step, (m, 8, 3).
void element_steps(Points points, Hexes hexes, double s, double rho, CornerVectors places);

// Write targets (n, 3): for each of `nodes`, the mean of `places` (m, 8, 3) over its hexes, by their weights (m,).
void weighted_means(std::span<const std::array<double, 24>> places, Numbers weights, const HexMesh &mesh, Indices nodes,
                    std::span<Point> targets);

// Shorten moves until no hex that was valid is inverted; returns the number of shortened moves. In each round the nodes
// of inverted hexes halve their moves; the fourth halving gives the move up.
std::int64_t relax(Points points, const HexMesh &mesh, std::span<const bool> valid, Indices harmed,
                   std::span<Point> moved);

}  // namespace hexmend
