// Metrics of every hex from its six faces: points (n, 3), hexes (m, 8), results (m,).
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

// Smallest and largest angle of adjacent edges of a face, in degrees; 0 and 180 where an edge has no length.
void angles(Points points, Hexes hexes, std::span<double> smallest, std::span<double> largest);

// Largest over the faces of 1 - min((n0 . n2)^3, (n1 . n3)^3), n the unit normals at the face's corners; 2 where a
// corner has no normal.
void warpage(Points points, Hexes hexes, std::span<double> worst);

// Volume inside the six bilinear faces; negative for an inverted hex.
void volume(Points points, Hexes hexes, std::span<double> enclosed);

}  // namespace hexmend
