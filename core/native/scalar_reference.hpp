// Scalar reference of the kernels: the same formulas, one hex after another, without vectors. `hexmend bench` measures
// kernels against it. Functions and arguments are those of objective.hpp and local.hpp.
#pragma once

#include "energy/objective.hpp"
#include "smoothers/local.hpp"

namespace hexmend::scalar {

void energies(Points points, Hexes hexes, double delta, double offset, OmittedCorners omitted, std::span<double> eta,
              const TargetMatrices *target = nullptr);

void gradient(Points points, Hexes hexes, double delta, ObjectiveNorm norm, OmittedCorners omitted,
              CornerVectors shares, const TargetMatrices *target = nullptr);

void hessian_product(Points points, Hexes hexes, Hexes slots, Points values, double delta, ObjectiveNorm norm,
                     OmittedCorners omitted, CornerVectors shares, const TargetMatrices *target = nullptr);

std::int64_t local_sweep(std::span<Point> points, const HexMesh &mesh, Indices groups, Indices nodes,
                         const NodeStepSettings &settings);

}  // namespace hexmend::scalar
