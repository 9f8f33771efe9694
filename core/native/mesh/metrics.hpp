// Metrics of every hex: points (n, 3), hexes (m, 8), results (m,) or (m, 8). bindings/mesh.cpp defines each.
//
// Stimpson, Ernst, Knupp, Pébay and Thompson: The Verdict Geometric Quality Library, SAND2007-1751.
#pragma once

#include "energy/target.hpp"
#include "mesh/array_views.hpp"

namespace hexmend {

// From the eight corner tetrahedra, in one pass at delta = 0: q(H), (2.10); the smallest corner determinant sigma,
// (2.9); the smallest scaled Jacobian; and eta(H), (B.20). A tetrahedron with sigma <= 0, or too large for a float, has
// q = 0 and eta = INF.
void measure(Points points, Hexes hexes, std::span<double> q, std::span<double> sigma, std::span<double> jacobian,
             std::span<double> eta);

// q(H) and eta(H) of hexes with a target: q(T) = 1/eta(T), in which the size counts too.
void measure_against(Points points, Hexes hexes, const TargetMatrices &target, std::span<double> q,
                     std::span<double> eta);

// q(T), (2.8), and sigma, (2.9), of the corner tetrahedra.
void corner_qualities(Points points, Hexes hexes, ArrayView<double, 8> q);
void corner_determinants(Points points, Hexes hexes, ArrayView<double, 8> sigma);

// Scaled Jacobians of the corner tetrahedra, sigma/(|u||v||w|); -1 where an edge has no length.
void corner_jacobians(Points points, Hexes hexes, ArrayView<double, 8> jacobians);

// Mean length of the hexes' edges, each counted once per hex; 0 without hexes.
double mean_edge_length(Points points, Hexes hexes);

// Lower lengths (n,), at the nodes of hexes, to that of the shortest edge at each.
void lower_to_edges(Points points, Hexes hexes, std::span<double> lengths);

// From the six faces.
void angles(Points points, Hexes hexes, std::span<double> smallest, std::span<double> largest);
void warpage(Points points, Hexes hexes, std::span<double> worst);
void volume(Points points, Hexes hexes, std::span<double> enclosed);

// From edges E and diagonals D: max E / min E; sqrt(3) min E / max D; min D / max D.
void lengths(Points points, Hexes hexes, std::span<double> edge_ratio, std::span<double> stretch,
             std::span<double> diagonal);

// From the principal axes.
void axes(Points points, Hexes hexes, std::span<double> aspect_ratio, std::span<double> skew, std::span<double> taper);

// Smallest 3 sigma^(2/3) / |S|^2 and largest |S| |S^-1| / 3 of the corner tetrahedra.
void corners(Points points, Hexes hexes, std::span<double> shape, std::span<double> condition);

// Determinant of the Jacobian at the centre.
void centre(Points points, Hexes hexes, std::span<double> jacobian);

}  // namespace hexmend
