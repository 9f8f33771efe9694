// What values at nodes come to over the corners of each hex; on one thread, because a window's thread asks.
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

void largest(Hexes hexes, Numbers of_nodes, std::span<double> of_hexes);

void mean(Hexes hexes, Numbers of_nodes, std::span<double> of_hexes);

}  // namespace hexmend
