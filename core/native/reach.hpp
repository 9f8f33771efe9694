// How far the nodes may go in one step.
#pragma once

#include "rows.hpp"

namespace hexmend {

void shorten(std::span<Point> step, Points points, Indices ring_start, Indices ring, Indices nodes, double reach);

}  // namespace hexmend
