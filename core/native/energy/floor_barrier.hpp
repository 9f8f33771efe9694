// Barrier of floors: of the scaled Jacobian of each corner of a hex, and of its quality q(H).
//
// With y = (value - floor)/band for the scaled Jacobian of a corner, and for q(H), each contributes weight * b(y) with
//
//     b(y) = -log y + (y - 1) - (y - 1)^2/2     for 0 < y < 1
//
// which is 0 from y = 1 on with two continuous derivatives, and infinite from y = 0 down: only what is near its floor
// takes part.
#pragma once

#include "energy/assembly.hpp"

namespace hexmend {

// Floors of hexes. Bit t of `ignored` is set where corner t has no floor.
struct Floors {
    std::span<const double> jacobians;  // (m,) of the scaled Jacobians of its corners; -INF: none
    std::span<const double> qualities;  // (m,) of q(H); -INF: none
    OmittedCorners ignored;
    double jacobian_band, quality_band, weight;

    void check() const {
        expect(have_rows(jacobians.size(), qualities, ignored),
               "jacobians, qualities and ignored have different lengths: expected a row a hex");
    }
};

// Write q(H) of every hex, (m,), with a target that of S W^-1; omitted corners count as perfect.
void floor_qualities(Points points, Hexes hexes, OmittedCorners omitted, std::span<double> values,
                     const TargetMatrices *target = nullptr);

// Write the contribution of every hex, (m,).
void floor_values(Points points, Hexes hexes, const Floors &floors, OmittedCorners omitted, std::span<double> values,
                  const TargetMatrices *target = nullptr);

// Add the derivatives by the corners of every hex to shares.
void add_floor_gradient(Points points, Hexes hexes, const Floors &floors, OmittedCorners omitted, CornerVectors shares,
                        const TargetMatrices *target = nullptr);

// Add the second derivatives to the blocks above and on the diagonal, as `assemble` does.
template <class Real>
void assemble_floors(Points points, const Floors &floors, OmittedCorners omitted, const HexShares &shared,
                     std::span<std::array<Real, 9>> off_diagonal, std::span<std::array<Real, 6>> diagonal,
                     const TargetMatrices *matrices = nullptr);

}  // namespace hexmend
