// Ambient occlusion of polygons.
#pragma once

#include "view/polygons.hpp"

namespace hexmend {

// Write the unit normal of each polygon's mean plane; 0 for a polygon without area.
void normals(Points points, PointNumbers start, PointNumbers places, std::span<Point> answer);

// Add the light from `directions` (j, 3), unit vectors, that reaches each corner of the polygons to `light`, and the
// light that would reach it without occlusion to `whole`; both have one number per corner. `side` is the size of the
// height maps in pixels.
void shine(Points points, PointNumbers start, PointNumbers places, Points normals, Points directions, std::int64_t side,
           std::span<double> light, std::span<double> whole);

}  // namespace hexmend
