// Symmetric 3 x 3 matrices and what is done with them at a node, for those who want to see it alone.
#pragma once

#include <array>
#include <utility>

namespace hexmend {

std::pair<double, double> extremes_of(std::array<double, 6> a);

std::array<double, 3> solution_of(std::array<double, 6> a, std::array<double, 3> b);

std::array<double, 3> newton_step(std::array<double, 6> hessian, std::array<double, 3> gradient, bool modified);

}  // namespace hexmend
