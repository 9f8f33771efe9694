// Sum of eta(H)^p over a mesh: energies, gradient, Hessian product.
//
// Every hex writes its contributions at its own eight corners, (m, 8, 3); `gather` sums them at nodes, always in the
// same order, so that results do not depend on the number of threads. Without a target hexes are to be cubes.
#pragma once

#include "energy/objective_norm.hpp"
#include "energy/target.hpp"
#include "mesh/array_views.hpp"

namespace hexmend {

// Write eta(H) = mean eta(T) - offset of every hex, (m,).
void energies(Points points, Hexes hexes, double delta, double offset, OmittedCorners omitted, std::span<double> eta,
              const TargetMatrices *target = nullptr);

// Write the gradient of sum eta(H)^p by the corners of every hex: (B.3), (B.21).
void gradient(Points points, Hexes hexes, double delta, ObjectiveNorm norm, OmittedCorners omitted,
              CornerVectors shares, const TargetMatrices *target = nullptr);

// Write the Hessian of sum eta(H)^p times a displacement of the free nodes, values (k, 3): (B.19) corrected.
void hessian_product(Points points, Hexes hexes, Hexes slots, Points values, double delta, ObjectiveNorm norm,
                     OmittedCorners omitted, CornerVectors shares, const TargetMatrices *target = nullptr);

// Write rows (k, 3): the sums of the contributions at each of `nodes` (k,), over its corners in ascending order.
void gather(std::span<const Point> shares, Indices start, Indices corners, Indices nodes, std::span<Point> rows);

}  // namespace hexmend
