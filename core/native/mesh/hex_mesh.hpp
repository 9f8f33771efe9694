// Connectivity of a mesh.
#pragma once

#include "mesh/csr.hpp"

namespace hexmend {

// Corners of hexes at one node, 8 * hex + corner each.
using Star = std::span<const std::int32_t>;

// Hexes, and the corners of hexes at each node.
struct HexMesh {
    Hexes hexes;      // (m, 8)
    Indices start;    // (n + 1,): the corners at node i are corners[start[i]] to corners[start[i + 1] - 1]
    Indices corners;  // (8 m,), result of `node_corners`

    void check() const { expect_corners(hexes.size(), start, corners); }

    std::size_t nodes() const { return start.size() - 1; }

    Star star(Node i) const { return corners.subspan(start[i], start[i + 1] - start[i]); }

    // The largest number of hexes at a node.
    int largest_star() const { return widest(start); }
};

// Throw unless there is a point for each node of the mesh.
inline void expect_points(const HexMesh &mesh, Points points) {
    expect(points.size() == mesh.nodes(), "points: a row for each node of the mesh is expected");
}

}  // namespace hexmend
