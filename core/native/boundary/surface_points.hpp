// Points of large surfaces: equal ones, fans of faces around them, and those with the largest and the least value in
// each cell of a lattice.
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

// The number of each point among the different ones, in the order of their first appearance; 0 and -0 are equal.
IntArray numbers_of_different_points(Points points);

// Number of fans, which are faces connected by edges, at each of `nodes` nodes. `faces` has the nodes of each face,
// `width` of them; its side s runs from faces[s] to the next of the face. Edge e has sides[first[e]] to sides[first[e +
// 1] - 1].
IntArray count_fans(Indices faces, int width, Indices sides, Indices first, std::int64_t nodes);

// True for the points with the largest and with the least value of each cell; of equal values the last is the largest,
// the first the least. cell (k,) is below `cells`.
OwnedArray<bool> extremes_in_cells(Indices cell, Numbers values, std::int64_t cells);

}  // namespace hexmend
