// Patches of several free nodes, and a sweep over them: one Newton step of each, with the other nodes fixed.
#pragma once

#include <tuple>

#include "mesh/hex_mesh.hpp"
#include "mesh/incidence.hpp"
#include "smoothers/local.hpp"

namespace hexmend {

// Patches as `partition` makes them: the hexes of patch p, and the slots of their corners among its nodes (-1: fixed),
// are the rows hex_start[p] to hex_start[p + 1] - 1, its nodes are nodes[node_start[p]] to nodes[node_start[p + 1] -
// 1].
struct PatchPartition {
    Hexes hexes, slots;
    Indices hex_start, node_start, nodes;

    void check() const {
        expect(hexes.size() == slots.size(), "slots: one row for each of the hexes is expected");
        expect(hex_start.size() == node_start.size(), "node_start: as many numbers as in hex_start are expected");
        expect(are_csr(hex_start, hexes.size()), "hexes: as many as the last of hex_start are expected");
        expect(are_csr(node_start, nodes.size()), "nodes: as many as the last of node_start are expected");
    }
};

// Divide the free nodes into connected patches of at most `size` nodes, which then overlap. Returns node_start, nodes,
// hex_start, patch_hexes and slots, see `PatchPartition`.
std::tuple<IntArray, IntArray, IntArray, IntArray, OwnedArray<std::int32_t, 8>> partition(const HexMesh &mesh,
                                                                                          std::span<const bool> free,
                                                                                          std::int64_t size,
                                                                                          int overlap);

// Groups of patches that share no hex, by greedy colouring.
CSR colours(Indices hex_start, Indices patch_hexes, std::int64_t hexes);

// Move the nodes of every patch by one Newton step together, in place; returns the evaluations of a hex's energy in
// line searches, and of its derivatives. Group g, patches[groups[g]] to patches[groups[g
// + 1] - 1], shares no hex. Lengths are in mean edge lengths of the patch; the direction is Newton's, and the target
// has a row for each row of the partition's hexes.
std::pair<std::int64_t, std::int64_t> patch_sweep(std::span<Point> points, const PatchPartition &partition,
                                                  Indices groups, Indices patches, const NodeStepSettings &settings);

}  // namespace hexmend
