// Assembly of the Hessian of a mesh's energy: a product with the matrix is much faster than with the formulas, and a
// preconditioner needs its blocks.
#pragma once

#include "energy/objective.hpp"
#include "energy/objective_norm.hpp"
#include "energy/target.hpp"
#include "linear/sparsity.hpp"

namespace hexmend {

using BlockTargets = std::span<const std::array<std::int32_t, PAIRS>>;

// Slots divided into shares that are assembled in parallel: share s has the slots bounds[s] to bounds[s + 1] - 1 and
// all hexes at these, rows start[s] to start[s + 1] - 1 of the other arrays.
struct HexShares {
    Indices bounds, start;
    Indices numbers;      // of the hexes in the mesh; a hex at slots of several shares is in each
    Hexes hexes, slots;   // (.., 8): nodes and slots of the corners, -1 where a corner is fixed
    BlockTargets target;  // (.., 28): block of each pair of corners: -1 if one is fixed, -2 - slot if both are one node
};

// Add the Hessian of sum eta(H)^p to the blocks above and on the diagonal, see block_matrix.hpp. Each share computes
// all its hexes, so that each block is summed in one order for any number of shares.
template <class Real>
void assemble(Points points, double delta, ObjectiveNorm norm, OmittedCorners omitted, const HexShares &shared,
              std::span<std::array<Real, 9>> off_diagonal, std::span<std::array<Real, 6>> diagonal,
              const TargetMatrices *matrices = nullptr);

}  // namespace hexmend
