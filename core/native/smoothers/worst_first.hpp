// Sequential GETMe: the worst hex takes its element step, again and again.
//
// The priority queue is a tournament tree in an array: leaves are hexes, and each inner node is the child of smaller
// key. The root, number 1, is the hex of smallest key; a changed key replays the matches from its leaf to the root.
#pragma once

#include "boundary/sliding_surface.hpp"
#include "mesh/hex_mesh.hpp"

namespace hexmend {

// The tree (2 k,) of the hexes (k,) by key (m,).
IntArray tournament(Numbers key, Indices hexes);

// Update the tree after the key of the hex at a leaf, 0 to k - 1, has changed.
void replay(std::span<std::int32_t> tree, Numbers key, std::int64_t leaf);

// Scale and blend of the element step. After its step a hex ranks as better by `penalty` if the step was accepted and
// by `rejection_penalty` if it was rejected, so that it is not chosen for ever.
struct WorstFirstSettings {
    double scaling, relaxation, penalty, rejection_penalty;
};

// Take as many element steps as there are candidates, the hexes with a free node; returns the number of rejected steps.
// points end at the best state reached, q and valid at the last one.
std::int64_t worst_first_sweep(std::span<Point> points, const HexMesh &mesh, std::span<const bool> free,
                               Indices candidates, std::span<double> q, std::span<bool> valid,
                               const WorstFirstSettings &settings, const SlidingSurface *surface);

}  // namespace hexmend
