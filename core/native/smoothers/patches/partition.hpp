// Partition of the free nodes into patches of several nodes that move together.
#pragma once

#include <tuple>

#include "mesh/hex_mesh.hpp"
#include "mesh/incidence.hpp"

namespace hexmend {

// Divide the free nodes (n,) into connected patches of at most `size` nodes, breadth first from the lowest remaining
// node; then add to each patch the nodes within `overlap` steps between nodes of one hex.
//
// Returns node_start and nodes: the nodes of each patch, ascending; hex_start and patch_hexes: the hexes at them; slots
// (k, 8): the number of each corner of these hexes among the patch's nodes, -1 if it is fixed.
std::tuple<OwnedArray<std::int32_t>, OwnedArray<std::int32_t>, OwnedArray<std::int32_t>, OwnedArray<std::int32_t>,
           OwnedArray<std::int32_t, 8>>
partition(const HexMesh &mesh, std::span<const bool> free, std::int64_t size, int overlap);

// Groups of patches that share no hex, by greedy colouring: CSR rows of patch numbers. hex_start and patch_hexes are
// those of `partition`, hexes the number of hexes of the mesh.
CSR colours(Indices hex_start, Indices patch_hexes, std::int64_t hexes);

}  // namespace hexmend
