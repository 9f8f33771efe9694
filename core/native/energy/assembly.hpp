// Assembly of the Hessian of a mesh's energy: a product with the matrix is much faster than with the formulas, and a
// preconditioner needs its blocks.
#pragma once

#include <algorithm>

#include "energy/objective.hpp"
#include "energy/objective_norm.hpp"
#include "energy/target.hpp"
#include "linear/packed_block.hpp"
#include "linear/sparsity.hpp"
#include "simd/simd_hexes.hpp"

namespace hexmend {

// Slots divided into shares that are assembled in parallel: share s has the slots bounds[s] to bounds[s + 1] - 1 and
// all hexes at these, numbers start[s] to start[s + 1] - 1.
struct HexShares {
    Indices bounds, start;
    Indices numbers;    // of the hexes in the mesh; a hex at slots of several shares is in each
    Hexes hexes;        // (m, 8), of the mesh
    Indices slots;      // (n,): slot of each node, -1 for a fixed one
    Indices row_start;  // (k + 1,): first block of each slot's row
    Indices columns;    // (blocks,)

    void check() const {
        expect(!bounds.empty() && start.size() == bounds.size(), "start: one for each of bounds is expected");
        expect(are_csr(start, numbers.size()), "numbers: as many as the last of start are expected");
        expect(std::cmp_equal(row_start.size(), std::int64_t{bounds.back()} + 1),
               "row_start: one more than the slots is expected");
        expect(are_csr(row_start, columns.size()), "columns: as many as the last of row_start are expected");
    }

    // Throw unless they are shares of a mesh with so many nodes and hexes, and a matrix has their pattern.
    void expect_sizes(std::size_t nodes, std::size_t hexes_of_mesh, std::size_t off_diagonal,
                      std::size_t diagonal) const {
        expect(slots.size() == nodes, "points: a row for each of the nodes of shares is expected");
        expect(hexes.size() == hexes_of_mesh, "omitted: one for each of the hexes of shares is expected");
        expect(off_diagonal == columns.size() + 1, "off_diagonal: a row for each of columns and one more are expected");
        expect(diagonal + 1 == row_start.size(), "diagonal: a row for each slot is expected");
    }

    // The number in the mesh of hex i of `count` from row `first` on; that of the last one beyond.
    std::int32_t number(std::int64_t first, int i, int count) const { return numbers[first + std::min(i, count - 1)]; }

    // Rows from `first` on, before `end`, of cells of one kind: a block.
    int alike(std::int64_t first, std::int64_t end) const {
        return hexmend::alike(std::min<std::int64_t>(LANES, end - first),
                              [&](int i) -> const Hex & { return hexes[numbers[first + i]]; });
    }

    Hex slots_of(std::int32_t hex) const {
        Hex of;
        for (int c = 0; c < 8; ++c) of[c] = slots[hexes[hex][c]];
        return of;
    }
};

// Add the Hessian of sum eta(H)^p to the blocks above and on the diagonal, see block_matrix.hpp. Each share computes
// all its hexes, so that each block is summed in one order for any number of shares.
template <class Real>
void assemble(Points points, double delta, ObjectiveNorm norm, OmittedCorners omitted, const HexShares &shared,
              std::span<std::array<Real, 9>> off_diagonal, std::span<std::array<Real, 6>> diagonal,
              const TargetMatrices *matrices = nullptr);

// As `assemble` in single precision, but the blocks above the diagonal are written, packed, and the diagonal gets what
// belongs to fixed nodes; `complete_diagonal` adds the rest. Slots from first_separator on are those of separators, see
// sparsity.hpp.
void assemble_packed(Points points, double delta, ObjectiveNorm norm, OmittedCorners omitted, const HexShares &shared,
                     std::int32_t first_separator, std::span<PackedBlock> off_diagonal,
                     std::span<std::array<float, 6>> diagonal, const TargetMatrices *matrices = nullptr);

}  // namespace hexmend
