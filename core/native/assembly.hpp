// The Hessian of a mesh's energy, assembled: 3 x 3 blocks of the free nodes, those above the diagonal and those on it.
//
// A product with it takes a fraction of the time of the formulas, and a preconditioner can look into it.
#pragma once

#include "couplings.hpp"

namespace hexmend {

// Where the blocks of hexes go; see `assemble`.
struct Pattern {
    Hexes slots;
    std::span<const std::array<std::int32_t, PAIRS>> target;
    Indices bounds, start, chosen;
};

template <class Real>
void assemble(Points points, Hexes hexes, double delta, double p, std::span<const std::uint8_t> left_out, Hexes slots,
              std::span<const std::array<std::int32_t, PAIRS>> target, Indices bounds, Indices start, Indices chosen,
              std::span<std::array<Real, 9>> off, std::span<std::array<Real, 6>> diagonal);

}  // namespace hexmend
