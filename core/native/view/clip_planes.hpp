// Sides of planes on which hexes lie: a point is beyond a plane if x . normal > offset; normals (k, 3), offsets (k,).
// The functions run on one thread, because the window's thread calls them.
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

// Write kept (m,): whether the centre of each hex remains. With `notch` what is beyond all planes is cut away, else
// what is beyond any of them.
void centres_kept(Points points, Hexes hexes, Points normals, Numbers offsets, bool notch, std::span<bool> kept);

// Write answer (m * k,), hex by hex: whether a plane crosses or touches a hex where the section is visible.
void touched(Points points, Hexes hexes, Points normals, Numbers offsets, bool notch, std::span<bool> answer);

}  // namespace hexmend
