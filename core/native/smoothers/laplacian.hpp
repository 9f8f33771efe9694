// Laplacian sweeps: a node moves to the mean of its edge neighbours (`node_rings`), projected if it slides on
// `surface`; nullptr for none.
#pragma once

#include "boundary/sliding_surface.hpp"
#include "mesh/hex_mesh.hpp"

namespace hexmend {

// Algorithm 3.1: one node after another, in place.
void in_place(std::span<Point> points, Indices ring_start, Indices ring, Indices nodes, const SlidingSurface *surface);

// True if most nodes of a sequence have the one before them in their ring: each waits for the mean of another.
bool most_wait(Indices ring_start, Indices ring, Indices nodes);

// Sweeps by Algorithm 3.1 over the same nodes, bit for bit as `in_place`; faster where most nodes wait.
//
// Nodes are sorted by wavefronts, of which no node waits for another, in short stretches of the sequence, and their
// points are stored in this order.
class LaplacianSweeps {
  public:
    // Begin at `points`, of which it keeps a copy; each node appears once in `nodes`.
    LaplacianSweeps(Points points, Indices ring_start, Indices ring, Indices nodes);

    // Make a sweep and write the points (n, 3) after it.
    void next(std::span<Point> points);

  private:
    // x, y and z, 0: registers that every processor has.
    typedef double Pair __attribute__((vector_size(16)));
    struct Place {
        Pair xy{}, z{};
    };

    std::vector<Node> nodes_;                        // those of the sweep by wavefronts, then the others
    std::vector<Place> places_;                      // of `nodes_`
    std::vector<std::int32_t> degree_, neighbours_;  // of the nodes of the sweep: their rings, by place in `nodes_`
};

// Write moved (n, 3): all nodes at once, from the old positions of the others.
void simultaneous(Points points, Indices ring_start, Indices ring, Indices nodes, std::span<Point> moved);

// Smart Laplacian: Algorithm 3.1, in which moves that do harm are rejected; returns their number.
std::int64_t smart_sweep(std::span<Point> points, const HexMesh &mesh, Indices ring_start, Indices ring, Indices nodes,
                         bool keep_least_quality, const SlidingSurface *surface);

}  // namespace hexmend
