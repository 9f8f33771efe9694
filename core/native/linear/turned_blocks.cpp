#include "linear/turned_blocks.hpp"

#include <cmath>

#include "simd/lanes.hpp"

namespace hexmend {
namespace {

constexpr std::int64_t BLOCKS_PER_CHUNK = 512;
constexpr int OF_SYMMETRIC[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5}, OF_UPPER[6] = {0, 1, 2, 4, 5, 8};

// The first product is rounded, as NumPy does it where processors have fused operations.
template <class Real> Real dot(const Real *a, int stride_a, const Real *b, int stride_b) {
    return uncontracted(a[0] * b[0]) + a[stride_a] * b[stride_b] + a[2 * stride_a] * b[2 * stride_b];
}

// T^T D T of a symmetric block D.
template <class Real> std::array<Real, 9> turned(const std::array<Real, 6> &block, const std::array<Real, 9> &turn) {
    std::array<Real, 9> d, half, own;
    for (int k = 0; k < 9; ++k) d[k] = block[OF_SYMMETRIC[k]];
    for (int k = 0; k < 9; ++k) half[k] = dot(&turn[k / 3], 3, &d[k % 3], 3);
    for (int k = 0; k < 9; ++k) own[k] = dot(&half[k / 3 * 3], 1, &turn[k % 3], 3);
    return own;
}

}  // namespace

template <class Real>
void turn_diagonal(std::span<const std::array<Real, 9>> turn, Indices slots, std::span<std::array<Real, 6>> diagonal) {
    expect(turn.size() == slots.size(), "turn: a row for each of slots is expected");
    parallel_for(slots.size(), BLOCKS_PER_CHUNK, [&](std::int64_t i) {
        std::array<Real, 6> &block = diagonal[slots[i]];
        const std::array<Real, 9> own = turned(block, turn[i]);
        for (int k = 0; k < 6; ++k) block[k] = own[OF_UPPER[k]];
    });
}

template <class Real>
void project_diagonal(std::span<const std::array<Real, 9>> projectors, Indices slots,
                      std::span<std::array<Real, 6>> diagonal) {
    expect(projectors.size() == slots.size(), "projectors: a row for each of slots is expected");
    parallel_for(slots.size(), BLOCKS_PER_CHUNK, [&](std::int64_t i) {
        const std::array<Real, 9> &p = projectors[i];
        std::array<Real, 6> &block = diagonal[slots[i]];
        const std::array<Real, 9> own = turned(block, p);
        const Real directions = p[0] + p[4] + p[8], trace = own[0] + own[4] + own[8];
        Real size = std::abs(trace / std::max(directions, Real{1}));
        if (!(size > 0)) size = 1;
        for (int k = 0; k < 6; ++k) {
            const int at = OF_UPPER[k];
            block[k] = own[at] + uncontracted(size * ((at % 4 == 0) - p[at]));
        }
    });
}

template void turn_diagonal<float>(std::span<const std::array<float, 9>>, Indices, std::span<std::array<float, 6>>);
template void turn_diagonal<double>(std::span<const std::array<double, 9>>, Indices, std::span<std::array<double, 6>>);
template void project_diagonal<float>(std::span<const std::array<float, 9>>, Indices, std::span<std::array<float, 6>>);
template void project_diagonal<double>(std::span<const std::array<double, 9>>, Indices,
                                       std::span<std::array<double, 6>>);

}  // namespace hexmend
