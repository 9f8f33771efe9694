// Conjugate gradients with an assembled Hessian, preconditioned by symmetric Gauss-Seidel.
//
// The preconditioner is M = (D + L) D^-1 (D + U), D being the diagonal blocks made positive definite, L and U = L' the
// blocks below and above it. Eisenstat's trick (1981) costs two triangular solves an iteration, and no product: for
// t = (D + U)^-1 v and A = L + A_D + U,
//
//     (D + L)^-1 A t = t + (D + L)^-1 (v - (2 D - A_D) t).
//
// Where several processes share a matrix, each has the rows of its own slots, with columns of ghosts, and D, L and U
// are those of its own slots: with the blocks R of the ghosts, R t joins v, t of the ghosts being received beforehand.
//
// Long waves, which Gauss-Seidel leaves, are solved for exactly in a coarse space R, if there is one: with P of
// coarse_space.hpp, P A t = P b is solved in place of A t = b, and x = R E^-1 R' b + P' t. In the trick, A t becomes
// P A t by a term on the right-hand side of its forward substitution, v - A R E^-1 (A R)' t.
//
// Slots are ordered in parts that share no block, followed by separators (`slots`): forward substitution solves
// the parts in parallel and then the separators, backward substitution the reverse.
#pragma once

#include <functional>
#include <tuple>

#include "linear/aggregates.hpp"
#include "linear/block_matrix.hpp"

namespace hexmend {

// Result of a solve: converged; stopped at a direction of negative curvature; too many iterations.
enum SolveStatus { DONE, NEGATIVE_CURVATURE, TOO_MANY };

// Contributions of the other processes that share a matrix; without functions there are none. Ghosts are the slots that
// follow the own ones. All processes call `exchange`, with ghosts or without: others may need slots of theirs.
template <class Real> struct Coupling {
    std::int64_t ghosts = 0;
    std::function<double(double)> sum;  // over all processes
    // Send rows of t (slots + ghosts, 4), and receive those of the ghosts.
    std::function<void(std::array<Real, 4> *t)> exchange;
};

// Numbers of the workspace of `solve`.
inline std::int64_t workspace_size(const BlockPattern &pattern, std::int64_t ghosts, bool coupled) {
    const auto slots = pattern.slots();
    return 23 * slots + 4 * (slots - pattern.first_separator()) + (coupled ? 4 * (slots + ghosts) : 0) + 16;
}

// Solve A x = right in the precision of the matrix; returns the iterations and the status.
//
// damping adds that multiple of D to the diagonal. The tolerance is relative to the right-hand side, both in the norm
// of M^-1; max_iterations limits the iterations. At a direction of negative curvature (Steihaug 1983) x is the iterate
// so far or, if it is the first, that direction. Vectors are (k, 4), see block_matrix.hpp; x may be `right`, which is
// then replaced. work: `workspace_size`, and with a coarse space `coarse_workspace_size` besides. Coupled processes
// have none.
template <class Block, class Real = NumberOf<Block>>
std::pair<int, SolveStatus> solve(const BlockPattern &pattern, UpperBlocks<Block> off_diagonal,
                                  DiagonalBlocks<Real> diagonal, double damping, Vectors<Real> right, double tolerance,
                                  int max_iterations, std::span<std::array<Real, 4>> x, std::span<Real> work,
                                  const Coupling<Real> &coupling, const CoarsePattern *coarse = nullptr);

// Write right-hand sides or solutions of nodes, scaled, to their slots and back: row k of `of_nodes` belongs to slot
// order[k]. The fourth number of a slot becomes 0.
template <class Real>
void to_slots(Points of_nodes, Indices order, double scale, std::span<std::array<Real, 4>> of_slots);
template <class Real> void from_slots(Vectors<Real> of_slots, Indices order, double scale, std::span<Point> of_nodes);

// Write y = A x (k, 3) in double precision; row k of x and y belongs to slot order[k].
template <class Block>
void product(const BlockPattern &pattern, UpperBlocks<Block> off_diagonal, DiagonalBlocks<NumberOf<Block>> diagonal,
             Indices order, Points x, std::span<Point> y);

}  // namespace hexmend
