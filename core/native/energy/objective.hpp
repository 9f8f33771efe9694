// Sum of eta(H)^p over a mesh: energies, gradient, Hessian product.
//
// Every hex writes its share into a block of its own; a node's row is the sum over the corners that meet there, always
// in the same order, so that results do not depend on the number of threads.
#pragma once

#include "energy/objective_norm.hpp"
#include "mesh/array_views.hpp"

namespace hexmend {

// Vectors at the eight corners of each hex.
using CornerVectors = std::span<std::array<double, 24>>;

void energies(Points points, Hexes hexes, double delta, double offset, OmittedCorners left_out, std::span<double> eta);

void gradient(Points points, Hexes hexes, double delta, ObjectiveNorm power, OmittedCorners left_out,
              CornerVectors shares);

void hessian_product(Points points, Hexes hexes, Hexes slots, Points values, double delta, ObjectiveNorm power,
                     OmittedCorners left_out, CornerVectors shares);

void gather(std::span<const Point> shares, Indices start, Indices corners, Indices nodes, std::span<Point> rows);

}  // namespace hexmend
