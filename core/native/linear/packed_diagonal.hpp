// Diagonal blocks of a matrix whose other blocks are packed.
#pragma once

#include "linear/block_matrix.hpp"

namespace hexmend {

// Complete the diagonal blocks (k, 6), which have the shares of fixed nodes, so that each row sums to these: they are
// less by the symmetric parts of the row's packed blocks. A translation of all nodes then meets no rounding error, and
// the errors of other displacements are relative to the differences of neighbours, as their energy is: long waves would
// otherwise have negative curvature. Returns the number of stretched blocks, see `is_stretched`.
std::int64_t complete_diagonal(const BlockPattern &pattern, UpperBlocks<PackedBlock> off_diagonal,
                               std::span<std::array<float, 6>> diagonal);

// True for a positive definite diagonal block whose eigenvalues differ so much that the rounding of packed blocks is
// not small beside the least: nodes of hexes that are flatter than 1 : 300.
bool is_stretched(const std::array<float, 6> &block);

}  // namespace hexmend
