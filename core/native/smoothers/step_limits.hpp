// Steps of nodes: their limits, and the points that they lead to.
#pragma once

#include "mesh/hex_mesh.hpp"

namespace hexmend {

// Shorten the steps (k, 3) of `nodes` (k,) that are longer than `reach` times the mean length of the node's edges.
void shorten(std::span<Point> step, Points points, const HexMesh &mesh, Indices nodes, double reach);

// Write moved (n, 3): points with `nodes` displaced by alpha times their steps (k, 3).
void displaced(Points points, Indices nodes, Points step, double alpha, std::span<Point> moved);

}  // namespace hexmend
