// Metrics of every hex by its six faces: angles, warpage, and the volume that they enclose.
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

void angles(Points points, Hexes hexes, std::span<double> smallest, std::span<double> largest);

void warpage(Points points, Hexes hexes, std::span<double> worst);

void volume(Points points, Hexes hexes, std::span<double> enclosed);

}  // namespace hexmend
