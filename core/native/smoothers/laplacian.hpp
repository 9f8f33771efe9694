// Laplacian sweeps: a node moves to the mean of its edge neighbours. ring_start and ring are `node_rings`, points (n,
// 3). Sweeps with a surface project the means of the nodes that slide; nullptr for none.
#pragma once

#include "boundary/sliding_surface.hpp"

namespace hexmend {

// Algorithm 3.1: one node after another, in place.
void in_place(std::span<Point> points, Indices ring_start, Indices ring, Indices nodes);

void in_place_on(const SlidingSurface *surface, std::span<Point> points, Indices ring_start, Indices ring,
                 Indices nodes);

// Write moved (n, 3): all nodes at once, from the old positions of the others.
void simultaneous(Points points, Indices ring_start, Indices ring, Indices nodes, std::span<Point> moved);

// Smart Laplacian: Algorithm 3.1, in which a move that inverts a sound hex or, with keep_least_quality, lowers the
// least q(H) of the hexes at the node is rejected. Returns the number of rejected moves.
std::int64_t guarded(std::span<Point> points, Hexes hexes, Indices start, Indices corners, Indices ring_start,
                     Indices ring, Indices nodes, bool keep_least_quality);

std::int64_t guarded_on(const SlidingSurface *surface, std::span<Point> points, Hexes hexes, Indices start,
                        Indices corners, Indices ring_start, Indices ring, Indices nodes, bool keep_least_quality);

}  // namespace hexmend
