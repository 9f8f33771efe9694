// Order of the nodes in a sweep, and groups of nodes that can be stepped at the same time.
#pragma once

#include "mesh/incidence.hpp"

namespace hexmend {

// Number of edges between each node and the nearest with from[i], (n,).
IntArray levels(Indices ring_start, Indices ring, std::span<const bool> from);

// Groups of the nodes of a sequence such that no hex has two nodes of one group, and a node's group follows those of
// all earlier nodes of its hexes: sweeping group after group equals sweeping the sequence.
CSR wavefronts(Indices start, Indices corners, Indices sequence);

}  // namespace hexmend
