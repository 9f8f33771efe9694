// The scalar formulas of a corner tetrahedron, for those who want to see them alone.
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

void powers(Numbers h, std::span<double> powers);

void barriers(Numbers sigma, double delta, std::span<double> h, std::span<double> r);

}  // namespace hexmend
