// Metrics of every hex from its edges, diagonals, principal axes and corners, as the Verdict library defines them:
// points (n, 3), hexes (m, 8), results (m,). faces.hpp has those of the faces.
//
// Stimpson, Ernst, Knupp, Pébay and Thompson: The Verdict Geometric Quality Library, SAND2007-1751.
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

// Edge ratio max E / min E; stretch sqrt(3) min E / max D; diagonal ratio min D / max D, of edges E and diagonals D.
void lengths(Points points, Hexes hexes, std::span<double> edge_ratio, std::span<double> stretch,
             std::span<double> diagonal);

// Aspect ratio, skew and taper of the principal axes.
void axes(Points points, Hexes hexes, std::span<double> aspect_ratio, std::span<double> skew, std::span<double> taper);

// Shape, the smallest 3 sigma^(2/3) / |S|^2, and condition, the largest |S| |S^-1| / 3, of the corner tetrahedra.
void corners(Points points, Hexes hexes, std::span<double> shape, std::span<double> condition);

// Determinant of the Jacobian at the centre.
void centre(Points points, Hexes hexes, std::span<double> jacobian);

}  // namespace hexmend
