// A 3 x 3 block in 24 bytes in place of 36: whole numbers of 20 bits times a power of two.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace hexmend {

// Nine numbers from -2^19 + 1 to 2^19 - 1, by rows: their upper 16 bits; the lower 4 bits of the ninth above the 8 bits
// of the exponent of the scale; the lower 4 bits of the others, of the first in the lowest bits of two numbers. Each
// number is rounded by at most 2^-19 of the largest of the block.
using PackedBlock = std::array<std::int16_t, 12>;

typedef float Vec8 __attribute__((vector_size(32)));
typedef std::int32_t Int8 __attribute__((vector_size(32)));
typedef std::int16_t Short8 __attribute__((vector_size(16)));

constexpr int PACKED_BITS = 19;  // without the sign
constexpr int NOT_FINITE = 255;  // exponent of a block that is not finite

// The float with these bits for its exponent: 2^(exponent - 127), for 255 not finite, and for 0 zero.
inline float scale_of(const PackedBlock &block) {
    auto bits = static_cast<std::uint32_t>(block[9] & 0xff) << 23;
    return std::bit_cast<float>(bits);
}

// Pack a block; one that is not finite stays so.
inline PackedBlock packed(const std::array<float, 9> &block) {
    Vec8 eight;
    std::memcpy(&eight, block.data(), sizeof eight);
    const auto signs = std::bit_cast<Int8>(eight) & (Int8{} + std::numeric_limits<std::int32_t>::min());
    // Floats that are not negative are in the order of their bits, and what is not finite comes last.
    auto sizes = std::bit_cast<Int8>(eight) ^ signs;
    auto larger = [](Int8 a, Int8 b) { return a > b ? a : b; };
    sizes = larger(sizes, __builtin_shufflevector(sizes, sizes, 4, 5, 6, 7, 0, 1, 2, 3));
    sizes = larger(sizes, __builtin_shufflevector(sizes, sizes, 2, 3, 0, 1, 6, 7, 4, 5));
    sizes = larger(sizes, __builtin_shufflevector(sizes, sizes, 1, 0, 3, 2, 5, 4, 7, 6));
    const auto most = std::max(sizes[0], std::bit_cast<std::int32_t>(std::abs(block[8])));
    PackedBlock result{};
    if (!std::isfinite(std::bit_cast<float>(most))) {
        result.fill(1), result[9] = NOT_FINITE;
        return result;
    }
    // The largest number becomes 2^18 to 2^19: less half of the last bit, so that it is not rounded to 2^19.
    const int exponent = (most + (1 << (23 - PACKED_BITS))) >> 23;  // of the largest
    const int scale = exponent - (PACKED_BITS - 1);
    if (scale <= 0) return result;  // underflow
    const float inverse = std::bit_cast<float>((254 - scale) << 23);
    const auto half = std::bit_cast<Vec8>(signs | std::bit_cast<Int8>(Vec8{} + 0.5f));
    const auto whole = __builtin_convertvector(eight * inverse + half, Int8);
    const auto last = static_cast<std::int32_t>(block[8] * inverse + std::copysign(0.5f, block[8]));
    const auto upper = __builtin_convertvector(whole >> 4, Short8);
    std::memcpy(result.data(), &upper, sizeof upper);
    auto fours = (whole & 15) << Int8{0, 4, 8, 12, 16, 20, 24, 28};
    fours |= __builtin_shufflevector(fours, fours, 4, 5, 6, 7, 0, 1, 2, 3);
    fours |= __builtin_shufflevector(fours, fours, 2, 3, 0, 1, 6, 7, 4, 5);
    fours |= __builtin_shufflevector(fours, fours, 1, 0, 3, 2, 5, 4, 7, 6);
    const auto lower = fours[0];
    result[8] = static_cast<std::int16_t>(last >> 4);
    result[9] = static_cast<std::int16_t>(scale | (last & 15) << 8);
    std::memcpy(&result[10], &lower, sizeof lower);
    return result;
}

// The whole numbers of a block.
inline std::array<std::int32_t, 9> whole_numbers(const PackedBlock &block) {
    std::array<std::int32_t, 9> numbers;
    std::uint32_t lower;
    std::memcpy(&lower, &block[10], sizeof lower);
    for (int i = 0; i < 8; ++i) numbers[i] = block[i] * 16 | static_cast<std::int32_t>(lower >> (4 * i) & 15);
    numbers[8] = block[8] * 16 | (block[9] >> 8 & 15);
    return numbers;
}

// The numbers of a block, and a zero.
inline std::array<float, 10> unpacked(const PackedBlock &block) {
    std::array<float, 10> result{};
    const auto numbers = whole_numbers(block);
    for (int i = 0; i < 9; ++i) result[i] = scale_of(block) * static_cast<float>(numbers[i]);
    return result;
}

}  // namespace hexmend
