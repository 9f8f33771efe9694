// GETMe: nodes go to means of the places that their hexes give them.
//
// Vartziotis and Wipper 2011, CMAME 200:1186; thesis 3.1.2.
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

void weighted_means(std::span<const std::array<double, 24>> places, Numbers weights, Indices start, Indices corners,
                    Indices nodes, std::span<Point> targets);

std::int64_t relax(Points points, Hexes hexes, Indices start, Indices corners, std::span<const bool> sound,
                   Indices harmed, std::span<Point> moved);

}  // namespace hexmend
