// A block of hexes side by side, one in each lane.
#pragma once

#include "rows.hpp"
#include "threads.hpp"

namespace hexmend {

// Hexes that one thread takes at a time: whole blocks, however wide they are.
constexpr std::int64_t CHUNK = 256;

namespace detail {

#if defined(__AVX512VL__)
inline __m256d three_numbers(const double *p) { return _mm256_maskz_loadu_pd(0b0111, p); }
#elif defined(__AVX__)
inline __m256d three_numbers(const double *p) { return _mm256_maskload_pd(p, _mm256_set_epi64x(0, -1, -1, -1)); }
#endif

// The vectors at row[0], row[1]... side by side.
inline V3<double> side_by_side(const Point *const (&row)[1]) { return {(*row[0])[0], (*row[0])[1], (*row[0])[2]}; }

inline V3<Lanes> side_by_side(const Point *const (&row)[LANES]) {
#if defined(__AVX512F__)
    auto two = [&](int i) {
        return __builtin_shufflevector(three_numbers(row[i]->data()), three_numbers(row[i + 4]->data()),  //
                                       0, 1, 2, 3, 4, 5, 6, 7);
    };
    Lanes a = two(0), b = two(1), c = two(2), d = two(3);  // x0 y0 z0 - x4 y4 z4 -, ...
    Lanes xz = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14), y = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
    Lanes more_xz = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14), more_y = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
    return {__builtin_shufflevector(xz, more_xz, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(y, more_y, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(xz, more_xz, 2, 3, 10, 11, 6, 7, 14, 15)};
#elif defined(__AVX__)
    Lanes a = three_numbers(row[0]->data()), b = three_numbers(row[1]->data());
    Lanes c = three_numbers(row[2]->data()), d = three_numbers(row[3]->data());
    Lanes xz = __builtin_shufflevector(a, b, 0, 4, 2, 6), more_xz = __builtin_shufflevector(c, d, 0, 4, 2, 6);
    Lanes y = __builtin_shufflevector(a, b, 1, 5, 3, 7), more_y = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    return {__builtin_shufflevector(xz, more_xz, 0, 1, 4, 5), __builtin_shufflevector(y, more_y, 0, 1, 4, 5),
            __builtin_shufflevector(xz, more_xz, 2, 3, 6, 7)};
#else
    const Point &a = *row[0], &b = *row[1];
    return {Lanes{a[0], b[0]}, Lanes{a[1], b[1]}, Lanes{a[2], b[2]}};
#endif
}

}  // namespace detail

// Corners of `count` hexes from `first` on; further lanes repeat the last.
template <class T> inline Corners<T> gathered(Points points, Hexes hexes, std::int64_t first, int count) {
    const Point *row[8][width<T>];
    for (int i = 0; i < width<T>; ++i) {
        const Hex &hex = hexes[first + (i < count ? i : count - 1)];
        for (int c = 0; c < 8; ++c) row[c][i] = &points[hex[c]];
    }
    Corners<T> x;
    for (int c = 0; c < 8; ++c) x.at[c] = detail::side_by_side(row[c]);
    return x;
}

// The same of values that some corners have, by their slot; zero where it is below 0.
template <class T> inline Corners<T> gathered_or_zero(Points values, Hexes slots, std::int64_t first, int count) {
    static constexpr Point ZERO{};
    const Point *row[8][width<T>];
    for (int i = 0; i < width<T>; ++i) {
        const Hex &hex = slots[first + (i < count ? i : count - 1)];
        for (int c = 0; c < 8; ++c) row[c][i] = hex[c] >= 0 ? &values[hex[c]] : &ZERO;
    }
    Corners<T> x;
    for (int c = 0; c < 8; ++c) x.at[c] = detail::side_by_side(row[c]);
    return x;
}

// The same corners less the first: sums of them are as exact far from the origin.
template <class T> inline Corners<T> from_first_corner(const Corners<T> &x) {
    Corners<T> less;
    for (int c = 0; c < 8; ++c) less.at[c] = x.at[c] - x.at[0];
    return less;
}

// Write the lanes of a block, a number of each hex.
inline void put(const Lanes &x, std::int64_t first, int count, std::span<double> values) {
    for (int i = 0; i < count; ++i) values[first + i] = x[i];
}

// Which corner tetrahedra count: bit t of a hex is set where number t is left out, as if it were perfect.
template <class T> struct Counted {
    bits_of<T> left_out;

    Counted(std::span<const std::uint8_t> bits, std::int64_t first, int count) {
        alignas(64) std::int64_t buffer[width<T>] = {};
        for (int i = 0; i < count; ++i) buffer[i] = bits[first + i];
        std::memcpy(&left_out, buffer, sizeof left_out);
    }

    auto operator()(int t) const { return (left_out & (std::int64_t{1} << t)) == 0; }
};

// First and second derivatives of max(eta(H), 0)^p by eta(H), of each hex of a block.
template <class T> struct BlockWeights {
    T first{}, second{};

    BlockWeights() = default;

    BlockWeights(T energy, double p) {
        if (p == 2) {
            auto counts = energy >= 0.0;
            first = counts ? 2.0 * energy : all<T>(0.0), second = counts ? all<T>(2.0) : all<T>(0.0);
            return;
        }
        for (int i = 0; i < width<T>; ++i) {
            auto [one, two] = weights(lane(energy, i), p);
            set_lane(first, i, one), set_lane(second, i, two);
        }
    }
};

// body(first, count) for every block of the hexes, on all threads.
template <class T, class Body> inline void blocks_of(std::int64_t hexes, const Body &body) {
    parallel_chunks(hexes, CHUNK, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t first = begin; first < end; first += width<T>)
            body(first, static_cast<int>(end - first < width<T> ? end - first : width<T>));
    });
}

}  // namespace hexmend
