// Blocks of cells of one kind, one cell in each lane: loading, storing and looping over them.
#pragma once

#include "energy/objective_norm.hpp"
#include "mesh/array_views.hpp"
#include "simd/threads.hpp"

namespace hexmend {

// Hexes that one thread takes at a time: a multiple of every number of lanes.
constexpr std::int64_t HEXES_PER_CHUNK = 256;

namespace detail {

#if defined(__AVX512VL__)
inline __m256d three_numbers(const Point &p) { return _mm256_maskz_loadu_pd(0b0111, p.data()); }
#elif defined(__AVX__)
inline __m256d three_numbers(const Point &p) { return _mm256_maskload_pd(p.data(), _mm256_set_epi64x(0, -1, -1, -1)); }
#endif

}  // namespace detail

// The vectors at(0), at(1), ..., one in each lane: a transposing load.
template <class T, class At> inline __attribute__((always_inline)) V3<T> load_lanes(const At &at) {
    if constexpr (width<T> == 1) {
        const Point &p = at(0);
        return {p[0], p[1], p[2]};
    } else {
#if defined(__AVX512F__)
        auto two = [&](int i) __attribute__((always_inline)) {
            return __builtin_shufflevector(detail::three_numbers(at(i)), detail::three_numbers(at(i + 4)),  //
                                           0, 1, 2, 3, 4, 5, 6, 7);
        };
        Lanes a = two(0), b = two(1), c = two(2), d = two(3);  // x0 y0 z0 - x4 y4 z4 -, ...
        Lanes xz = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
        Lanes y = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
        Lanes more_xz = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
        Lanes more_y = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
        return {__builtin_shufflevector(xz, more_xz, 0, 1, 8, 9, 4, 5, 12, 13),
                __builtin_shufflevector(y, more_y, 0, 1, 8, 9, 4, 5, 12, 13),
                __builtin_shufflevector(xz, more_xz, 2, 3, 10, 11, 6, 7, 14, 15)};
#elif defined(__AVX__)
        Lanes a = detail::three_numbers(at(0)), b = detail::three_numbers(at(1));
        Lanes c = detail::three_numbers(at(2)), d = detail::three_numbers(at(3));
        Lanes xz = __builtin_shufflevector(a, b, 0, 4, 2, 6), more_xz = __builtin_shufflevector(c, d, 0, 4, 2, 6);
        Lanes y = __builtin_shufflevector(a, b, 1, 5, 3, 7), more_y = __builtin_shufflevector(c, d, 1, 5, 3, 7);
        return {__builtin_shufflevector(xz, more_xz, 0, 1, 4, 5), __builtin_shufflevector(y, more_y, 0, 1, 4, 5),
                __builtin_shufflevector(xz, more_xz, 2, 3, 6, 7)};
#else
        const Point &a = at(0), &b = at(1);
        return {Lanes{a[0], b[0]}, Lanes{a[1], b[1]}, Lanes{a[2], b[2]}};
#endif
    }
}

// Transpose a square of LANES x LANES numbers.
inline void transpose(Lanes (&rows)[LANES]) {
#if defined(__AVX512F__)
    Lanes a[8], b[8];
    for (int k = 0; k < 8; k += 2) {
        a[k] = __builtin_shufflevector(rows[k], rows[k + 1], 0, 8, 2, 10, 4, 12, 6, 14);
        a[k + 1] = __builtin_shufflevector(rows[k], rows[k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
    }
    for (int k = 0; k < 8; k += 4)
        for (int j = 0; j < 2; ++j) {
            b[k + j] = __builtin_shufflevector(a[k + j], a[k + j + 2], 0, 1, 8, 9, 4, 5, 12, 13);
            b[k + j + 2] = __builtin_shufflevector(a[k + j], a[k + j + 2], 2, 3, 10, 11, 6, 7, 14, 15);
        }
    for (int k = 0; k < 4; ++k) {
        rows[k] = __builtin_shufflevector(b[k], b[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
        rows[k + 4] = __builtin_shufflevector(b[k], b[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
    }
#elif defined(__AVX__)
    Lanes a = __builtin_shufflevector(rows[0], rows[1], 0, 4, 2, 6),
          b = __builtin_shufflevector(rows[0], rows[1], 1, 5, 3, 7);
    Lanes c = __builtin_shufflevector(rows[2], rows[3], 0, 4, 2, 6),
          d = __builtin_shufflevector(rows[2], rows[3], 1, 5, 3, 7);
    rows[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5), rows[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
    rows[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7), rows[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
#else
    Lanes a = rows[0], b = rows[1];
    rows[0] = Lanes{a[0], b[0]}, rows[1] = Lanes{a[1], b[1]};
#endif
}

// Vectors at the corners of `count` hexes from number `first` on, at(node) of each; unused lanes repeat the last hex.
template <class T, class At>
inline Corners<T> gather_vectors(Hexes hexes, std::int64_t first, int count, const At &at) {
    const Hex *hex[width<T>];
    for (int i = 0; i < width<T>; ++i) hex[i] = &hexes[first + (i < count ? i : count - 1)];
    Corners<T> x;
    for (int c = 0; c < 8; ++c) x.at[c] = load_lanes<T>([&](int i) -> const Point & { return at((*hex[i])[c]); });
    return x;
}

// Corner coordinates.
template <class T> inline Corners<T> gather_corners(Points points, Hexes hexes, std::int64_t first, int count) {
    return gather_vectors<T>(hexes, first, count, [&](Node node) -> const Point & { return points[node]; });
}

// values[slot], or zero where the slot is negative.
template <class T> inline Corners<T> gather_corners_or_zero(Points values, Hexes slots, std::int64_t first, int count) {
    static constexpr Point ZERO{};
    return gather_vectors<T>(slots, first, count,
                             [&](Node slot) -> const Point & { return slot >= 0 ? values[slot] : ZERO; });
}

// Write the vectors at the corners of `count` hexes, 24 numbers each, to values[first], ...
template <class T>
inline void store(const Corners<T> &x, std::int64_t first, int count, std::span<std::array<double, 24>> values) {
    T numbers[24], rows[width<T>];
    std::memcpy(numbers, &x, sizeof x);
    for (int k = 0; k < 24; k += width<T>) {
        std::memcpy(rows, numbers + k, sizeof rows);
        if constexpr (width<T> > 1) transpose(rows);
        for (int i = 0; i < count; ++i) std::memcpy(&values[first + i][k], &rows[i], sizeof(T));
    }
}

// Corners relative to the first one: far from the origin sums of absolute coordinates would lose digits.
template <class T> inline Corners<T> from_first_corner(const Corners<T> &x) {
    Corners<T> less;
    for (int c = 0; c < 8; ++c) less.at[c] = x.at[c] - x.at[0];
    return less;
}

// Write one number of each of `count` hexes to values[first], ...
inline void store(const Lanes &x, std::int64_t first, int count, std::span<double> values) {
    for (int i = 0; i < count; ++i) values[first + i] = x[i];
}

// Corner tetrahedra that count in the hexes of a block: all but those that `OmittedCorners` omits.
template <class T> class CornerMask {
  public:
    // Of `count` hexes from number `first` on.
    CornerMask(OmittedCorners omitted, std::int64_t first, int count) {
        alignas(64) std::int64_t buffer[width<T>] = {};
        for (int i = 0; i < count; ++i) buffer[i] = omitted[first + i];
        std::memcpy(&omitted_, buffer, sizeof omitted_);
    }

    // The lanes in whose hex tetrahedron t counts.
    auto operator()(int t) const { return (omitted_ & (std::int64_t{1} << t)) == 0; }

  private:
    bits_of<T> omitted_;  // bit t of a lane
};

// Call body(counted) for a block of hexes; counted(t) is the mask of the hexes whose tetrahedron t counts. Blocks
// without omitted tetrahedra, nearly all, get a compile-time constant instead of a mask.
template <class T, class Body>
inline __attribute__((always_inline)) void with_corner_mask(OmittedCorners omitted, std::int64_t first, int count,
                                                            const Body &body) {
    bool some = false;
    for (int i = 0; i < count; ++i) some |= omitted[first + i] != 0;
    if (some) body(CornerMask<T>(omitted, first, count));
    else body([](int) { return std::true_type{}; });
}

// `PowerDerivatives` of each cell of a block.
template <class T> struct LanePowerDerivatives {
    T first{}, second{};

    LanePowerDerivatives() = default;

    LanePowerDerivatives(T energy, double p) {
        if (p == 2) {
            auto perfect = energy < 0.0;
            first = perfect ? broadcast<T>(0.0) : 2.0 * energy,
            second = perfect ? broadcast<T>(0.0) : broadcast<T>(2.0);
            return;
        }
        for (int i = 0; i < width<T>; ++i) {
            auto [one, two] = power_derivatives(lane(energy, i), p);
            set_lane(first, i, one), set_lane(second, i, two);
        }
    }
};

// Of cells, from the sum of their eta(T): by an eighth of that sum.
template <class Cell, class T> inline LanePowerDerivatives<T> power_derivatives_of(T sum, double offset, double p) {
    LanePowerDerivatives<T> by(sum * Cell::share - offset, p);
    if constexpr (!Cell::is_cube) {
        by.first = Cell::share_of_eighths * by.first;
        by.second = (Cell::share_of_eighths * Cell::share_of_eighths) * by.second;
    }
    return by;
}

// The number of rows row(0), row(1), ... that are of one kind: at most `most`, a block's width.
template <class Row> inline int alike(std::int64_t most, const Row &row) {
    const CellKind kind = kind_of(row(0));
    int count = 1;
    while (count < most && kind_of(row(count)) == kind) ++count;
    return count;
}

// Call body(cell, first, count) for every block of cells, on all threads.
template <class T, class Body> inline void for_each_block(Hexes cells, const Body &body) {
    parallel_chunks(cells.size(), HEXES_PER_CHUNK, [&](std::int64_t begin, std::int64_t end) {
        int count = 0;
        for (std::int64_t first = begin; first < end; first += count) {
            count = alike(std::min<std::int64_t>(end - first, width<T>),
                          [&](int i) -> const Hex & { return cells[first + i]; });
            with_kind(cells[first], [&](auto cell) { body(cell, first, count); });
        }
    });
}

// Call body(cell, corners, first, count) for every block of cells.
template <class T, class Body> inline void for_each_corners(Points points, Hexes cells, const Body &body) {
    for_each_block<T>(cells, [&](auto cell, std::int64_t first, int count) {
        body(cell, gather_corners<T>(points, cells, first, count), first, count);
    });
}

}  // namespace hexmend
