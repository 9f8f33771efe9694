// Steps of nodes: how far they may go, and where they lead.
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

void shorten(std::span<Point> step, Points points, Indices ring_start, Indices ring, Indices nodes, double reach);

void displaced(Points points, Indices nodes, Points step, double alpha, std::span<Point> moved);

}  // namespace hexmend
