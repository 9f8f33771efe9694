// Quality of every hex from its eight corner tetrahedra, in one pass.
//
// points (n, 3), hexes (m, 8).
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

// Write q(H), (2.10); the smallest corner determinant sigma, (2.9); the smallest scaled Jacobian; and eta(H), (B.20),
// at delta = 0. All are (m,). A tetrahedron with sigma <= 0, or too large for a float, has q = 0 and eta = INF.
void measure(Points points, Hexes hexes, std::span<double> q, std::span<double> sigma, std::span<double> jacobian,
             std::span<double> eta);

// Write q(T), (2.8), of the eight corner tetrahedra of every hex, (m, 8); 0 as in `measure`.
void corner_qualities(Points points, Hexes hexes, ArrayView<double, 8> q);

// Mean length of the hexes' edges, each counted once per hex; 0 without hexes.
double mean_edge_length(Points points, Hexes hexes);

// Write sigma, (2.9), of the eight corner tetrahedra of every hex, (m, 8).
void corner_determinants(Points points, Hexes hexes, ArrayView<double, 8> sigma);

}  // namespace hexmend
