// Metrics of every hex by its edges, diagonals, principal axes and corners, as the Verdict library defines them.
//
// Stimpson, Ernst, Knupp, Pébay and Thompson: The Verdict Geometric Quality Library, SAND2007-1751. One pass writes the
// metrics that share its lengths. Angles, warpage and volume go by faces: faces.hpp.
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

void lengths(Points points, Hexes hexes, std::span<double> edge_ratio, std::span<double> stretch,
             std::span<double> diagonal);

void axes(Points points, Hexes hexes, std::span<double> aspect_ratio, std::span<double> skew, std::span<double> taper);

void corners(Points points, Hexes hexes, std::span<double> shape, std::span<double> condition);

void centre(Points points, Hexes hexes, std::span<double> jacobian);

}  // namespace hexmend
