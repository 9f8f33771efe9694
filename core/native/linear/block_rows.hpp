// Rows of 3 x 3 blocks times vectors.
#pragma once

#include <array>
#include <cstring>
#include <type_traits>

#include "linear/packed_block.hpp"
#include "simd/lanes.hpp"

namespace hexmend {

// Vectors have four numbers for each slot, the fourth being 0. A row of a block is loaded as four numbers, the last of
// which belongs to the next row and is multiplied by that 0; the array of blocks therefore has one more block.
template <class Real> struct Vec4Type {
    typedef Real type __attribute__((vector_size(4 * sizeof(Real))));
};
template <class Real> using Vec4 = typename Vec4Type<Real>::type;

template <class Real> inline Vec4<Real> load(const Real *from) {
    Vec4<Real> x;
    std::memcpy(&x, from, sizeof x);
    return x;
}

// Sums of the four numbers of x, y and z, and a fourth number 0.
template <class V> inline V horizontal_sums(const V &x, const V &y, const V &z) {
    V xy = __builtin_shufflevector(x, y, 0, 4, 1, 5) + __builtin_shufflevector(x, y, 2, 6, 3, 7);
    V z0 = __builtin_shufflevector(z, V{}, 0, 4, 1, 5) + __builtin_shufflevector(z, V{}, 2, 6, 3, 7);
    return __builtin_shufflevector(xy, z0, 0, 1, 4, 5) + __builtin_shufflevector(xy, z0, 2, 3, 6, 7);
}

// Row k of a block.
template <class Number, class Real, std::size_t n> inline Vec4<Number> row_of(const std::array<Real, n> &block, int k) {
    auto four = load(block.data() + 3 * k);
    if constexpr (std::is_same_v<Real, Number>) return four;
    else return __builtin_convertvector(four, Vec4<Number>);
}

// Sum of blocks times vectors.
template <class Stored, class Number> struct RowSum {
    Vec4<Number> x{}, y{}, z{};

    void add(const Stored &block, const Vec4<Number> &t) {
        x += row_of<Number>(block, 0) * t, y += row_of<Number>(block, 1) * t, z += row_of<Number>(block, 2) * t;
    }
    Vec4<Number> total() const { return horizontal_sums(x, y, z); }
};

// Products of transposed blocks with one vector. Their fourth number may be anything.
template <class Stored, class Number> struct Transposed {
    Vec4<Number> x, y, z;

    explicit Transposed(const Vec4<Number> &p)
        : x(p[0] - Vec4<Number>{}), y(p[1] - Vec4<Number>{}), z(p[2] - Vec4<Number>{}) {}
    Vec4<Number> operator()(const Stored &block) const {
        return row_of<Number>(block, 0) * x + row_of<Number>(block, 1) * y + row_of<Number>(block, 2) * z;
    }
};

template <class Number> struct RowSum<PackedBlock, Number> : RowSum<std::array<float, 10>, Number> {
    void add(const PackedBlock &block, const Vec4<Number> &t) {
        RowSum<std::array<float, 10>, Number>::add(unpacked(block), t);
    }
};

template <class Number> struct Transposed<PackedBlock, Number> : Transposed<std::array<float, 10>, Number> {
    using Transposed<std::array<float, 10>, Number>::Transposed;

    Vec4<Number> operator()(const PackedBlock &block) const {
        return Transposed<std::array<float, 10>, Number>::operator()(unpacked(block));
    }
};

// Eight of the numbers of a packed block at once, and the ninth; without its scale.
struct PackedNumbers {
    Vec8 eight;
    Vec4<float> ninth, scale;  // each four times

    explicit PackedNumbers(const PackedBlock &block) {
        typedef std::int32_t Int4 __attribute__((vector_size(16)));
        Short8 upper;
        std::int32_t lower, last;
        std::memcpy(&upper, block.data(), sizeof upper);
        std::memcpy(&last, block.data() + 8, sizeof last);
        std::memcpy(&lower, block.data() + 10, sizeof lower);
#if defined(__AVX2__)  // GCC would extend four numbers at a time
        const auto wide = std::bit_cast<Int8>(_mm256_cvtepi16_epi32(std::bit_cast<__m128i>(upper)));
#else
        const auto wide = __builtin_convertvector(upper, Int8);
#endif
        const Int8 fours = (lower - Int8{}) >> Int8{0, 4, 8, 12, 16, 20, 24, 28};
        eight = __builtin_convertvector(wide << 4 | (fours & 15), Vec8);
        const Int4 both = last - Int4{};
        ninth = __builtin_convertvector(both << 16 >> 12 | (both >> 24 & 15), Vec4<float>);
        scale = std::bit_cast<Vec4<float>>((both >> 16 & 255) << 23);
    }
};

template <> struct RowSum<PackedBlock, float> {
    Vec8 eight{};
    Vec4<float> ninth{};

    void add(const PackedBlock &block, const Vec4<float> &t) {
        const PackedNumbers a(block);
        const auto of = a.scale * t;
        const auto twice = __builtin_shufflevector(of, of, 0, 1, 2, 3, 0, 1, 2, 3);
        eight += a.eight * __builtin_shufflevector(twice, twice, 0, 1, 2, 0, 5, 6, 4, 5);
        ninth += a.ninth * of;
    }
    Vec4<float> total() const {
        return Vec4<float>{eight[0] + eight[1] + eight[2], eight[3] + eight[4] + eight[5],
                           eight[6] + eight[7] + ninth[2], 0};
    }
};

template <> struct Transposed<PackedBlock, float> {
    Vec8 eight;
    Vec4<float> ninth;

    explicit Transposed(const Vec4<float> &p)
        : eight{p[0], p[0], p[0], p[1], p[1], p[1], p[2], p[2]}, ninth{0, 0, p[2], 0} {}
    Vec4<float> operator()(const PackedBlock &block) const {
        const PackedNumbers a(block);
        const auto all = a.eight * eight;
        const auto first = __builtin_shufflevector(all, all, 0, 1, 2, 0);
        const auto rest = __builtin_shufflevector(all, all, 3, 4, 5, 3, 6, 7, 6, 6);  // the seventh is below
        const auto second = __builtin_shufflevector(rest, rest, 0, 1, 2, 3);
        const auto third = __builtin_shufflevector(rest, Vec8{}, 4, 5, 8, 8);
        return a.scale * (first + second + third + a.ninth * ninth);
    }
};

}  // namespace hexmend
