// Laplacian sweeps: a node moves to the mean of its edge neighbours (`node_rings`), projected if it slides on
// `surface`; nullptr for none.
#pragma once

#include "boundary/sliding_surface.hpp"
#include "mesh/hex_mesh.hpp"

namespace hexmend {

// Algorithm 3.1: one node after another, in place.
void in_place(std::span<Point> points, Indices ring_start, Indices ring, Indices nodes, const SlidingSurface *surface);

// Write moved (n, 3): all nodes at once, from the old positions of the others.
void simultaneous(Points points, Indices ring_start, Indices ring, Indices nodes, std::span<Point> moved);

// Smart Laplacian: Algorithm 3.1, in which moves that do harm are rejected; returns their number.
std::int64_t smart_sweep(std::span<Point> points, const HexMesh &mesh, Indices ring_start, Indices ring, Indices nodes,
                         bool keep_least_quality, const SlidingSurface *surface);

}  // namespace hexmend
