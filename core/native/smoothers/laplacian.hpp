// Laplacian sweeps: a node goes to the mean of its edge neighbours.
#pragma once

#include "boundary/sliding_surface.hpp"

namespace hexmend {

void in_place(std::span<Point> points, Indices ring_start, Indices ring, Indices nodes);

// The same with nodes that slide among them.
void in_place_on(const SlidingSurface *surface, std::span<Point> points, Indices ring_start, Indices ring,
                 Indices nodes);

void simultaneous(Points points, Indices ring_start, Indices ring, Indices nodes, std::span<Point> moved);

std::int64_t guarded(std::span<Point> points, Hexes hexes, Indices start, Indices corners, Indices ring_start,
                     Indices ring, Indices nodes, bool keep_least_quality);

std::int64_t guarded_on(const SlidingSurface *surface, std::span<Point> points, Hexes hexes, Indices start,
                        Indices corners, Indices ring_start, Indices ring, Indices nodes, bool keep_least_quality);

}  // namespace hexmend
