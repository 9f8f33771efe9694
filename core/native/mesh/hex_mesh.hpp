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

    // Write the edge neighbours of a node, ascending, and return their number, at most 3 for each hex of its star.
    int ring(Node i, Node *to) const {
        int size = 0;
        for (auto corner : star(i))
            for (int k = 1; k < 4; ++k)
                if (Node j = hexes[corner / 8][CORNER_TETRAHEDRA[corner % 8][k]]; j != i) placed(to, size, j);
        return size;
    }
};

// Throw unless there is a point for each node of the mesh.
inline void expect_points(const HexMesh &mesh, Points points) {
    expect(points.size() == mesh.nodes(), "points: a row for each node of the mesh is expected");
}

}  // namespace hexmend
