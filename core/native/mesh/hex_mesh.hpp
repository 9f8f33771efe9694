// Connectivity of a mesh.
#pragma once

#include "mesh/csr.hpp"

namespace hexmend {

// The edges of a kind of cells at each of its nodes, three or four: their other ends, and the two faces that meet
// there.
struct EdgesAtNode {
    int count = 0, ends[4] = {}, faces[4][2] = {};
};

constexpr auto EDGES_AT_NODE = [] {
    std::array<std::array<EdgesAtNode, 8>, CELL_KINDS> all{};
    for (int kind = 0; kind < CELL_KINDS; ++kind) {
        auto &table = CELL_TABLES[kind];
        auto add = [&](int node, int end) {
            auto &at = all[kind][node];
            int sides = 0;
            for (int f = 0; f < table.faces; ++f) {
                bool one = false, other = false;
                for (int corner : table.face_nodes[f]) one |= corner == node, other |= corner == end;
                if (one && other) at.faces[at.count][sides++] = f;
            }
            at.ends[at.count++] = end;
        };
        for (int node = 0; node < table.nodes; ++node) {
            if (node < table.corners) {
                for (int k = 1; k < 4; ++k) add(node, table.corner_tetrahedra[node][k]);
                continue;
            }
            for (int e = 0; e < table.edges; ++e)
                for (int k = 0; k < 2; ++k)
                    if (table.edge_ends[e][k] == node) add(node, table.edge_ends[e][1 - k]);
        }
    }
    return all;
}();

inline const EdgesAtNode &edges_at(const Hex &cell, int node) { return EDGES_AT_NODE[kind_of(cell)][node]; }

inline std::span<const int> neighbours_at(const Hex &cell, int node) {
    auto &at = edges_at(cell, node);
    return {at.ends, static_cast<std::size_t>(at.count)};
}

// Corners of cells at one node, 8 * cell + corner each.
using Star = std::span<const std::int32_t>;

// Cells, and their corners at each node.
struct HexMesh {
    Hexes hexes;      // (m, 8)
    Indices start;    // (n + 1,): the corners at node i are corners[start[i]] to corners[start[i + 1] - 1]
    Indices corners;  // result of `node_corners`

    void check() const { expect_corners(hexes.size(), start, corners); }

    std::size_t nodes() const { return start.size() - 1; }

    Star star(Node i) const { return corners.subspan(start[i], start[i + 1] - start[i]); }

    // The largest number of hexes at a node.
    int largest_star() const { return widest(start); }

    // Write the edge neighbours of a node, ascending, and return their number, at most 4 for each cell of its star.
    int ring(Node i, Node *to) const {
        int size = 0;
        for (auto corner : star(i))
            for (int end : neighbours_at(hexes[corner / 8], corner % 8))
                if (Node j = hexes[corner / 8][end]; j != i) placed(to, size, j);
        return size;
    }
};

// Throw unless there is a point for each node of the mesh.
inline void expect_points(const HexMesh &mesh, Points points) {
    expect(points.size() == mesh.nodes(), "points: a row for each node of the mesh is expected");
}

}  // namespace hexmend
