// Convex polygons cut off at planes; on one thread, because a window's thread asks.
#pragma once

#include <tuple>

#include "mesh/array_views.hpp"

namespace hexmend {

using PointNumbers = std::span<const std::int64_t>;

std::tuple<OwnedArray<double, 3>, OwnedArray<std::int64_t>, OwnedArray<std::int64_t>> before(
    Points points, PointNumbers start, PointNumbers places, PointNumbers owner, Points normals, Numbers offsets);

}  // namespace hexmend
