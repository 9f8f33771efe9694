// Figures of every hex in one pass over its eight corner tetrahedra.
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

void measure(Points points, Hexes hexes, std::span<double> q, std::span<double> sigma, std::span<double> jacobian,
             std::span<double> eta);

double mean_edge_length(Points points, Hexes hexes);

void corner_determinants(Points points, Hexes hexes, ArrayView<double, 8> sigma);

}  // namespace hexmend
