// The Hessian of a mesh's energy, assembled: 3 x 3 blocks of the free nodes, those above the diagonal and those on it.
//
// A product with it takes a fraction of the time of the formulas, and a preconditioner can look into it.
#pragma once

#include "energy/objective.hpp"
#include "energy/objective_norm.hpp"
#include "linear/sparsity.hpp"

namespace hexmend {

using BlockTargets = std::span<const std::array<std::int32_t, PAIRS>>;

template <class Real>
void assemble(Points points, double delta, ObjectiveNorm power, OmittedCorners left_out, Indices bounds, Indices start,
              Indices chosen, Hexes hexes, Hexes slots, BlockTargets target, std::span<std::array<Real, 9>> off,
              std::span<std::array<Real, 6>> diagonal);

}  // namespace hexmend
