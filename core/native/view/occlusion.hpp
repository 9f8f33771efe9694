// How much of the light from all around reaches the corners of polygons that stand in each other's way.
#pragma once

#include "view/polygons.hpp"

namespace hexmend {

// The normal of each polygon's mean plane, of length 1; 0 for one without an area.
void normals(Points points, PointNumbers start, PointNumbers places, std::span<Point> answer);

// Adds to `light` and `whole`, a number a corner (see `Places`), what reaches it from each of some directions, and what
// would if nothing stood in its way.
void shine(Points points, PointNumbers start, PointNumbers places, Points normals, Points directions, std::int64_t side,
           std::span<double> light, std::span<double> whole);

}  // namespace hexmend
