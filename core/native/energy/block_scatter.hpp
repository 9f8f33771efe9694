// Adding the second derivatives of a hex to the blocks of a matrix.
#pragma once

#include <algorithm>

#include "energy/hex_hessian.hpp"

namespace hexmend {

template <class Real> using Mask = std::conditional_t<sizeof(Real) == 4, std::int32_t, std::int64_t>;

// Add a 3 x 3 block, or its transpose, to another: the transpose is one shuffle of the first eight numbers.
template <class Real> inline void add_block(const Real *block, int transposed, std::array<Real, 9> &to) {
    asm("" : "+r"(transposed));  // keeps the compiler from an unpredictable branch
    typedef Real Vector __attribute__((vector_size(8 * sizeof(Real))));
    typedef Mask<Real> MaskVector __attribute__((vector_size(8 * sizeof(Real))));
    Vector rows, there;
    std::memcpy(&rows, block, sizeof rows);
    std::memcpy(&there, to.data(), sizeof there);
    Vector columns = __builtin_shufflevector(rows, rows, 0, 3, 6, 1, 4, 7, 2, 5);
    MaskVector which = MaskVector{} - static_cast<Mask<Real>>(transposed);
    there += bit_cast<Vector>((bit_cast<MaskVector>(columns) & which) | (bit_cast<MaskVector>(rows) & ~which));
    std::memcpy(to.data(), &there, sizeof there);
    to[8] += block[8];
}

template <class Real> inline void add_diagonal(const Real *own, std::array<Real, 6> &to) {
    typedef Real Vector __attribute__((vector_size(4 * sizeof(Real))));
    Vector four, there;
    std::memcpy(&four, own, sizeof four);
    std::memcpy(&there, to.data(), sizeof there);
    there += four;
    std::memcpy(to.data(), &there, sizeof there);
    to[4] += own[4], to[5] += own[5];
}

// Add a block and its transpose to a diagonal block: for a hex that uses a node twice.
template <class Real> void add_with_transpose(const Real *block, std::array<Real, 6> &own) {
    int at = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j) own[at++] += block[3 * i + j] + block[3 * j + i];
}

// Subtract the symmetric part of a block from a diagonal block.
template <class Real> void subtract_symmetric(const Real *block, std::array<Real, 6> &own) {
    int at = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j) own[at++] -= (block[3 * i + j] + block[3 * j + i]) / 2;
}

// Block of each pair of a hex's corners: -1 if a corner is fixed, -2 - slot if both are one node.
using PairBlocks = std::array<std::int32_t, PAIRS>;

inline PairBlocks blocks_of(const Hex &slots, Indices row_start, Indices columns) {
    typedef std::int32_t Eight __attribute__((vector_size(32)));
    Eight all;
    std::memcpy(&all, slots.data(), sizeof all);
    std::int32_t found[8][8];  // block of row slots[a] and column slots[b], -1 for none
    for (int a = 0; a < 8; ++a) {
        Eight blocks = Eight{} - 1;
        if (slots[a] >= 0)
            for (auto s = row_start[slots[a]]; s < row_start[slots[a] + 1]; ++s)
                blocks = all == Eight{} + columns[s] ? Eight{} + s : blocks;
        std::memcpy(found[a], &blocks, sizeof blocks);
    }
    PairBlocks blocks;
    int pair = 0;
    for (int a = 0; a < 8; ++a)
        for (int b = a + 1; b < 8; ++b, ++pair) {
            blocks[pair] = std::max(found[a][b], found[b][a]);
            if (slots[a] == slots[b] && slots[a] >= 0) blocks[pair] = -2 - slots[a];
        }
    return blocks;
}

// Add the values of a hex to the blocks of slots from `low` to `high`.
template <class Real, class Blocks>
void scatter(const Real *values, const Hex &slots, const PairBlocks &target, std::int32_t low, std::int32_t high,
             Blocks &off_diagonal, std::span<std::array<Real, 6>> diagonal) {
    constexpr bool from_fixed_nodes = requires { Blocks::diagonal_from_fixed_nodes; };
    int pair = 0;
    for (int a = 0; a < 8; ++a) {
        auto i = slots[a];
        bool mine = low <= i && i < high;
        for (int b = a + 1; b < 8; ++b, ++pair) {
            auto s = target[pair], j = slots[b];
            auto row = std::min(i, j);
            if (s >= 0 && low <= row && row < high) add_block(values + 9 * pair, i > j, off_diagonal[s]);
            else if constexpr (from_fixed_nodes) {
                if (row >= 0) continue;
                if (auto free = std::max(i, j); low <= free && free < high)
                    subtract_symmetric(values + 9 * pair, diagonal[free]);
            } else if (s < -1 && mine) add_with_transpose(values + 9 * pair, diagonal[i]);
        }
        if (!from_fixed_nodes && mine) add_diagonal(values + DIAGONAL_OFFSET + 6 * a, diagonal[i]);
    }
}

}  // namespace hexmend
