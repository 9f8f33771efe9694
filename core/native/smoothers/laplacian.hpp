// Laplacian sweeps: a node moves to the mean of its edge neighbours. ring_start and ring are `node_rings`, points (n,
// 3). Sweeps with a surface project the means of the nodes that slide; nullptr for none.
#pragma once

#include "boundary/sliding_surface.hpp"
#include "mesh/hex_mesh.hpp"

namespace hexmend {

// Algorithm 3.1: one node after another, in place.
void in_place(std::span<Point> points, Indices ring_start, Indices ring, Indices nodes, const SlidingSurface *surface);

// Write moved (n, 3): all nodes at once, from the old positions of the others.
void simultaneous(Points points, Indices ring_start, Indices ring, Indices nodes, std::span<Point> moved);

// Smart Laplacian: Algorithm 3.1, in which a move that inverts a sound hex or, with keep_least_quality, lowers the
// least q(H) of the hexes at the node is rejected. Returns the number of rejected moves.
std::int64_t smart_sweep(std::span<Point> points, const HexMesh &mesh, Indices ring_start, Indices ring, Indices nodes,
                         bool keep_least_quality, const SlidingSurface *surface);

}  // namespace hexmend
