// On which side of planes hexes lie; on one thread, because a window's thread asks.
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

void centres_kept(Points points, Hexes hexes, Points normals, Numbers offsets, bool notch, std::span<bool> kept);

void touched(Points points, Hexes hexes, Points normals, Numbers offsets, bool notch, std::span<bool> answer);

}  // namespace hexmend
