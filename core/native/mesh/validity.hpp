// Validity of hexes: is det J, the determinant of the map from the unit cube, positive everywhere?
//
// Along each axis the map of a hex of 8 nodes has degree d = 1, that of 27 nodes d = 2, and det J degree 3 d - 1. Its
// values lie between its least and greatest Bernstein coefficient; at the corners of the cube they are coefficients.
// Subdivision (de Casteljau) brings the coefficients as near to the values as is needed.
//
// Johnen, Remacle, Geuzaine: Geometrical validity of curvilinear finite elements, J. Comput. Phys. 233 (2013);
// Johnen, Weill, Remacle: Robust and efficient validation of the linear hexahedral element, Proc. Eng. 203 (2017).
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

// INVERTED: det J <= 0 at a corner; INVALID_INSIDE: only elsewhere; UNDECIDED: within rounding of 0 at the last level
// of the subdivision.
enum Validity : std::uint8_t { VALID, INVERTED, INVALID_INSIDE, UNDECIDED };

// Nodes of a hex of the second order, in the order of its lattice: x slowest, z fastest.
using QuadraticHexes = ArrayView<const double, 81>;

// The `Validity` of each hex, (m,).
void certify(Points points, Hexes hexes, std::span<std::uint8_t> validity);
void certify_quadratic(QuadraticHexes nodes, std::span<std::uint8_t> validity);

// A lower bound of the least det J of each hex, and an upper bound of the greatest, (m, 2): each as near to the extreme
// as a hundredth of it, or as a ten-millionth of the greatest coefficient.
void jacobian_bounds(Points points, Hexes hexes, ArrayView<double, 2> bounds);
void jacobian_bounds_quadratic(QuadraticHexes nodes, ArrayView<double, 2> bounds);

// A lower bound of the least over all hexes of their least det J, over the greatest det J of the same hex: from -1
// to 1.
double least_jacobian(Points points, Hexes hexes);
double least_jacobian_quadratic(QuadraticHexes nodes);

// The 27 Bernstein coefficients of det J of each hex, (m, 27): x slowest, z fastest.
void jacobian_coefficients(Points points, Hexes hexes, ArrayView<double, 27> coefficients);

}  // namespace hexmend
