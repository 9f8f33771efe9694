// Points and edges of large surfaces: equal points, edges of faces, fans of faces around points, values around
// edges.
#pragma once

#include <tuple>

#include "mesh/array_views.hpp"

namespace hexmend {

// The number of each point among the different ones, in the order of their first appearance; 0 and -0 are equal.
IntArray numbers_of_different_points(Points points);

// The edges of faces: the nodes of each, the lower one first, ascending; the sides that lie on each, ascending; and the
// place of its first side, with one more at the end. `faces` has the nodes of each face, `width` of them, below
// `nodes`; its side s runs from faces[s] to the next of the face. A side between equal nodes lies on no edge.
std::tuple<OwnedArray<std::int32_t, 2>, IntArray, IntArray> edges_of_faces(Indices faces, int width,
                                                                           std::int64_t nodes);

// Number of fans, which are faces connected by edges, at each of `nodes` nodes. `faces` has the nodes of each face,
// `width` of them; its side s runs from faces[s] to the next of the face. Edge e has sides[first[e]] to sides[first[e +
// 1] - 1].
IntArray count_fans(Indices faces, int width, Indices sides, Indices first, std::int64_t nodes);

// Quantile of the values around each of some edges (s,): of the edges at its two nodes and at the neighbours of these,
// without the edge itself and without values above `most`; 0 where none is left. edges (e, 2) have values (e,); those
// at node i are ends[start[i]] / 2 to ends[start[i + 1] - 1] / 2. A share of the values, below 1, is less than the
// quantile.
OwnedArray<double> quantiles_around(ArrayView<const Node, 2> edges, Indices start, Indices ends, Numbers values,
                                    Indices some, double most, double share);

}  // namespace hexmend
