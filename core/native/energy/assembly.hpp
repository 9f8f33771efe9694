// Assembly of the Hessian of a mesh's energy: 3 x 3 blocks of the free nodes, above and on the diagonal.
//
// A product with the matrix is much faster than with the formulas, and a preconditioner needs its blocks.
#pragma once

#include "energy/objective.hpp"
#include "energy/objective_norm.hpp"
#include "linear/sparsity.hpp"

namespace hexmend {

using BlockTargets = std::span<const std::array<std::int32_t, PAIRS>>;

// Add the Hessian of sum eta(H)^p to the blocks off (blocks + 1, 9) and diagonal (k, 6).
//
// Slots are divided into shares, slots bounds[s] to bounds[s + 1] - 1 each, which are assembled in parallel. A share
// computes all hexes at its slots, numbers start[s] to start[s + 1] - 1 of the arrays chosen (hex of the mesh), hexes
// and slots (.., 8), and target (.., 28), so that each block is summed in one order for any number of shares. target is
// the block of each pair of corners: -1 if a corner is fixed, -2 - slot if both are one node. left_out (m,) omits
// corner tetrahedra.
template <class Real>
void assemble(Points points, double delta, ObjectiveNorm power, OmittedCorners left_out, Indices bounds, Indices start,
              Indices chosen, Hexes hexes, Hexes slots, BlockTargets target, std::span<std::array<Real, 9>> off,
              std::span<std::array<Real, 6>> diagonal);

}  // namespace hexmend
