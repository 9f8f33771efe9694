// Incidence of nodes, hexes, faces and edges; connected components and colours. All linear in the number of hexes.
//
// A corner of a hex is the number 8 * hex + corner. start and corners are the result of `node_corners`.
#pragma once

#include <tuple>

#include "mesh/array_views.hpp"

namespace hexmend {

// Corners at each of `nodes` nodes, ascending.
CSR node_corners(Hexes hexes, std::int64_t nodes);

// The hex behind each face, (m, 6), -1 for none; and the number of non-manifold faces, which lie on the nodes of others
// without being one of two with opposite order.
std::pair<OwnedArray<std::int32_t, 6>, std::int64_t> face_neighbours(Hexes hexes, Indices start, Indices corners,
                                                                     bool opposed);

// Corners at each node whose cones overlap wherever the nodes are, ascending: two faces at the node have the same two
// edges there, in one order as seen from their hexes. Faces that are collapsed at the node are left out.
CSR overlapping_corners(Hexes hexes, Indices start, Indices corners);

// Connected components by union-find with path halving: parent[i] is an item of i's component, at most i; in the
// beginning every item is its own parent. Join the items of each row of `width` items.
void join(std::span<std::int32_t> parent, Indices items, int width);

// Edge neighbours of each node, ascending; throws std::overflow_error if there are more than `max_items`.
CSR node_rings(Hexes hexes, Indices start, Indices corners, std::int64_t max_items);

// Colour of each chosen node, so that two nodes of one hex differ; -1 for the others.
IntArray greedy_colours(Indices start, Indices corners, std::span<const bool> chosen);

// Nodes of each of `count` colours, ascending; colour -1 is in no group.
CSR grouped(Indices colour, std::int64_t count);

// Number of edges between each node and the nearest with from[i], (n,).
IntArray levels(Indices ring_start, Indices ring, std::span<const bool> from);

// Groups of the nodes of a sequence such that no hex has two nodes of one group, and a node's group follows those of
// all earlier nodes of its hexes: sweeping group after group equals sweeping the sequence.
CSR wavefronts(Indices start, Indices corners, Indices sequence);

// Every edge once, (e, 2); the number of hexes around it; whether it is on the boundary.
std::tuple<OwnedArray<Node, 2>, IntArray, OwnedArray<bool>> edges(Hexes hexes, Indices start, Indices corners,
                                                                  Neighbours neighbours, std::int64_t max_items);

// Averages along dual sheets: each hex has three groups of four parallel edges, and edges of one group are neighbours.
// Edges of a group; the number of edges stands for none.
using EdgeGroups = ArrayView<const std::int32_t, 4>;

// Average of the values of edges over the groups around each edge: the mean of the groups' means; 0 and a count of 0
// where there is none. The last value stands for no edge.
void average_along_sheets(EdgeGroups groups, Numbers values, std::span<double> average, std::span<std::int32_t> count);

}  // namespace hexmend
