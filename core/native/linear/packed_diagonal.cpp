#include "linear/packed_diagonal.hpp"

namespace hexmend {
namespace {

constexpr double MOST_STRETCHED = 1e5;

// Symmetric part of a block: xx xy xz yy, and yz zz.
struct SymmetricPart {
    Vec4<float> four{};
    float yz = 0, zz = 0;

    SymmetricPart() = default;
    explicit SymmetricPart(const PackedBlock &block) {
        const PackedNumbers a(block);
        const auto columns = __builtin_shufflevector(a.eight, a.eight, 0, 3, 6, 1, 4, 7, 2, 5);
        const auto both = (a.eight + columns) * (0.5f * a.scale[0]);
        four = __builtin_shufflevector(__builtin_shufflevector(both, both, 0, 1, 2, 4, 0, 1, 2, 4), Vec8{}, 0, 1, 2, 3);
        yz = both[5], zz = a.ninth[0] * a.scale[0];
    }

    void operator+=(const SymmetricPart &other) { four += other.four, yz += other.yz, zz += other.zz; }

    void subtract_from(std::array<float, 6> &block) const {
        const auto there = load(block.data()) - four;
        std::memcpy(block.data(), &there, sizeof there);
        block[4] -= yz, block[5] -= zz;
    }
};

}  // namespace

bool is_stretched(const std::array<float, 6> &block) {
    const auto a = widened(block);
    const auto [adjugate, det] = adjugate_of(a);
    const double trace = a.xx + a.yy + a.zz, minors = adjugate.xx + adjugate.yy + adjugate.zz;
    return det > 0 && trace > 0 && trace * minors > 2 * MOST_STRETCHED * det;
}

std::int64_t complete_diagonal(const BlockPattern &pattern, UpperBlocks<PackedBlock> off_diagonal,
                               std::span<std::array<float, 6>> diagonal) {
    const auto size = static_cast<std::int32_t>(pattern.slots());
    pattern.expect_blocks(off_diagonal.size(), diagonal.size());
    auto rows = [&](std::int64_t range) {
        for (auto i = pattern.bounds[range]; i < pattern.bounds[range + 1]; ++i) {
            SymmetricPart total;
            for (auto s = pattern.row_start[i]; s < pattern.row_start[i + 1]; ++s) {
                const SymmetricPart part(off_diagonal[s]);
                total += part;
                if (const auto j = pattern.columns[s]; j < size) part.subtract_from(diagonal[j]);
            }
            total.subtract_from(diagonal[i]);
        }
    };
    // Two parts, an even and an odd one, share a separator: the order of sums does not depend on the threads.
    const auto parts = static_cast<std::int64_t>(pattern.bounds.size()) / 2;
    for (int odd = 0; odd < 2; ++odd) parallel((parts + 1 - odd) / 2, [&](std::int64_t k) { rows(2 * k + odd); });
    parallel(parts - 1, [&](std::int64_t k) { rows(parts + k); });
    std::vector<std::int64_t> counts(2 * parts - 1);
    parallel(2 * parts - 1, [&](std::int64_t range) {
        for (auto i = pattern.bounds[range]; i < pattern.bounds[range + 1]; ++i)
            counts[range] += is_stretched(diagonal[i]);
    });
    std::int64_t total = 0;
    for (auto count : counts) total += count;
    return total;
}

}  // namespace hexmend
