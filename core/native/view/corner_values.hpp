// Values of hexes from values at their nodes: of_nodes (n,), of_hexes (m,). They run on one thread, because the
// window's thread calls them.
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

// Write the largest of the eight values.
void largest(Hexes hexes, Numbers of_nodes, std::span<double> of_hexes);

// Write the mean of the eight values.
void mean(Hexes hexes, Numbers of_nodes, std::span<double> of_hexes);

}  // namespace hexmend
