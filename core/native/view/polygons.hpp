// Convex polygons cut off at planes; on one thread, because a window's thread asks.
#pragma once

#include <tuple>

#include "mesh/array_views.hpp"

namespace hexmend {

using Places = std::span<const std::int64_t>;

std::tuple<Made<double, 3>, Made<std::int64_t>, Made<std::int64_t>> before(Points points, Places start, Places places,
                                                                           Places owner, Points normals,
                                                                           Numbers offsets);

}  // namespace hexmend
