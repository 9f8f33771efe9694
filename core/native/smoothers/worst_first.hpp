// The second stage of GETMe: the worst hex takes its step, again and again, from a priority queue.
//
// The queue is a tournament: a binary tree, kept in an array, with the hexes as leaves and in each node the one of its
// two children that has the lesser key. The root, number 1, is the hex of least key; a changed key replays the matches
// on the way from its leaf to the root.
#pragma once

#include "boundary/sliding_surface.hpp"

namespace hexmend {

OwnedArray<std::int32_t> tournament(Numbers key, Indices hexes);

void replay(std::span<std::int32_t> tree, Numbers key, std::int64_t leaf);

std::int64_t sweep(std::span<Point> points, Hexes hexes, Indices start, Indices corners, std::span<const bool> free,
                   Indices candidates, std::span<double> q, std::span<bool> sound, double s, double rho, double penalty,
                   double setback);

// The same with nodes that slide among them.
std::int64_t sweep_on(const SlidingSurface *surface, std::span<Point> points, Hexes hexes, Indices start,
                      Indices corners, std::span<const bool> free, Indices candidates, std::span<double> q,
                      std::span<bool> sound, double s, double rho, double penalty, double setback);

}  // namespace hexmend
