// Change of the coordinates of nodes in a symmetric matrix of 3 x 3 blocks.
#pragma once

#include "linear/block_matrix.hpp"

namespace hexmend {

// Replace the diagonal blocks D of `slots` (k,), none of them twice, by T^T D T, with turn T (k, 9).
template <class Real>
void turn_diagonal(std::span<const std::array<Real, 9>> turn, Indices slots, std::span<std::array<Real, 6>> diagonal);

// Replace the diagonal blocks D of `slots` (k,), none of them twice, by P D P + size (I - P), with the projectors P
// (k, 9), symmetric. size is the absolute mean of the eigenvalues along P, or 1 where it is 0 or not a number.
template <class Real>
void project_diagonal(std::span<const std::array<Real, 9>> projectors, Indices slots,
                      std::span<std::array<Real, 6>> diagonal);

// Replace the blocks `at` (j,) by T_row^T B T_column: rows and columns (j,) are indices in `turn`.
template <class Real>
void turn_blocks(std::span<const std::array<Real, 9>> turn, Indices at, Indices rows, Indices columns,
                 std::span<std::array<Real, 9>> off_diagonal) {
    constexpr std::int64_t BLOCKS_PER_CHUNK = 512;
    expect(rows.size() == at.size() && columns.size() == at.size(),
           "at, rows and columns have different lengths: expected a row a block");
    parallel_for(at.size(), BLOCKS_PER_CHUNK, [&](std::int64_t i) {
        const std::array<Real, 9> &left = turn[rows[i]], &right = turn[columns[i]];
        std::array<Real, 9> &block = off_diagonal[at[i]];
        Real half[9];
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c)
                half[3 * r + c] = left[r] * block[c] + left[3 + r] * block[3 + c] + left[6 + r] * block[6 + c];
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c)
                block[3 * r + c] =
                    half[3 * r] * right[c] + half[3 * r + 1] * right[3 + c] + half[3 * r + 2] * right[6 + c];
    });
}

}  // namespace hexmend
