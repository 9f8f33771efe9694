// Clipping of convex polygons. It runs on one thread, because the window's thread calls it.
#pragma once

#include <tuple>

#include "mesh/array_views.hpp"

namespace hexmend {

// Polygon i has the points numbered places[start[i]] to places[start[i + 1] - 1].
using PointNumbers = std::span<const std::int64_t>;

// Clip polygons to x . normal <= offset for all planes. Returns the points of the remaining polygons, one after
// another; their start; and the owner of each.
std::tuple<OwnedArray<double, 3>, OwnedArray<std::int64_t>, OwnedArray<std::int64_t>> before(
    Points points, PointNumbers start, PointNumbers places, PointNumbers owner, Points normals, Numbers offsets);

}  // namespace hexmend
