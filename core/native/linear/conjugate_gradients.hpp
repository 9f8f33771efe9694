// Conjugate gradients with an assembled Hessian, preconditioned by symmetric Gauss-Seidel.
//
// The preconditioner is M = (D + L) D^-1 (D + U), D being the diagonal blocks made positive definite, L and U = L' the
// blocks below and above it. Eisenstat's way (1981) costs two triangular solves an iteration, and no product: for
// t = (D + U)^-1 v and A = L + A_D + U,
//
//     (D + L)^-1 A t = t + (D + L)^-1 (v - (2 D - A_D) t).
//
// Slots are in parts that share no block, and behind them in separators, each between two parts: the parts are solved
// side by side, and then the separators, or the other way round, with nothing left out.
#pragma once

#include <tuple>

#include "mesh/array_views.hpp"

namespace hexmend {

// How a solve ended.
enum SolveStatus { DONE, NEGATIVE_CURVATURE, TOO_MANY };

template <class Real>
std::pair<int, int> solve(Indices bounds, Indices row_start, Indices columns, std::span<const std::array<Real, 9>> off,
                          std::span<const std::array<Real, 6>> diagonal, double damping,
                          std::span<const std::array<Real, 4>> right, double tolerance, int most,
                          std::span<std::array<Real, 4>> x, std::span<Real> work);

template <class Real>
void product(Indices bounds, Indices row_start, Indices columns, std::span<const std::array<Real, 9>> off,
             std::span<const std::array<Real, 6>> diagonal, std::span<const std::int64_t> order, Points x,
             std::span<Point> y);

}  // namespace hexmend
