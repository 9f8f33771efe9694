// Quality of cells and whether they are valid, that is, without inverted corner: q(T), (2.8), and q(H), (2.10).
//
// A lane holds one hex where many are evaluated; `SingleHex` holds one corner tetrahedron in each lane.
#pragma once

#include "energy/tetrahedron.hpp"
#include "simd/simd_hexes.hpp"

namespace hexmend {

// Result of comparing two T: bool, or a mask of lanes.
template <class T> using MaskOf = decltype(T{} > T{});

// q(T) = 3 sigma^(2/3)/|S|^2, (2.8); 0 where sigma <= 0.
template <class T> inline T quality(const M3<T> &s, T sigma) {
    return sigma > 0.0 ? 3.0 / (square(s) * power_minus_two_thirds(sigma)) : broadcast<T>(0.0);
}

// q(H), the mean of the q(T), and whether all corners have sigma > 0.
template <class T> struct Quality {
    T q;
    MaskOf<T> valid;
};

template <class Cell, class T> inline Quality<T> quality(const Corners<T> &x) {
    T total{};
    MaskOf<T> valid = broadcast<T>(0.0) == 0.0;
    unroll<Cell::corners>([&](auto t) {
        auto s = x.template shape<Cell, t>();
        T sigma = determinant(s);
        total += quality(s, sigma);
        valid = valid & (sigma > 0.0);
    });
    return {total * Cell::share, valid};
}

// One hex, its corners in lanes: corner c in lane c % LANES of register c / LANES.
class SingleHex {
  public:
    SingleHex(Points points, const Hex &hex) {
        for (int c = 0; c < 8; c += LANES)
            corners_[c / LANES] = load_lanes<Lanes>([&](int i) -> const Point & { return points[hex[c + i]]; });
    }

    Quality<double> quality() const {
        Lanes total{};
        bool valid = true;
        unroll<8 / LANES>([&](auto k) {
            auto s = edges<k * LANES>();
            Lanes sigma = determinant(s);
            total += hexmend::quality(s, sigma);
            valid &= positive(sigma);
        });
        return {sum(total) * 0.125, valid};
    }

    // True if no corner is inverted.
    bool valid() const {
        bool valid = true;
        unroll<8 / LANES>([&](auto k) { valid &= positive(determinant(edges<k * LANES>())); });
        return valid;
    }

  private:
    // The columns of S at the corner tetrahedra from `first` on.
    template <int first> M3<Lanes> edges() const {
        auto apex = ends<first, 0>();
        return {ends<first, 1>() - apex, ends<first, 2>() - apex, ends<first, 3>() - apex};
    }

    // Node number `end` of the corner tetrahedra from `first` on.
    template <int first, int end> V3<Lanes> ends() const {
        return {picked<first, end>([](auto &v) { return v.x; }), picked<first, end>([](auto &v) { return v.y; }),
                picked<first, end>([](auto &v) { return v.z; })};
    }

    template <int first, int end, class Component> Lanes picked(const Component &of) const {
        constexpr auto c = [](int i) { return CORNER_TETRAHEDRA[first + i][end]; };
        constexpr int last = 8 / LANES - 1;
        if constexpr (LANES == 8) {
            Lanes all = of(corners_[0]);
            return __builtin_shufflevector(all, all, c(0), c(1), c(2), c(3), c(4), c(5), c(6), c(7));
        } else if constexpr (LANES == 4) {
            return __builtin_shufflevector(of(corners_[0]), of(corners_[last]), c(0), c(1), c(2), c(3));
        } else {
            return __builtin_shufflevector(of(corners_[c(0) / 2]), of(corners_[c(1) / 2]), c(0) % 2, 2 + c(1) % 2);
        }
    }

    static bool positive(Lanes sigma) {
        Bits yes = sigma > 0.0;
        std::int64_t every = yes[0];
        for (int i = 1; i < LANES; ++i) every &= yes[i];
        return every != 0;
    }

    static double sum(Lanes x) {
        double total = x[0];
        for (int i = 1; i < LANES; ++i) total += x[i];
        return total;
    }

    V3<Lanes> corners_[8 / LANES];
};

// Of a cell of any kind.
inline Quality<double> cell_quality(Points points, const Hex &cell) {
    if (kind_of(cell) == HEXAHEDRON) return SingleHex(points, cell).quality();
    return with_kind(
        cell, [&](auto kind) { return quality<decltype(kind)>(gather_corners<double>(points, {&cell, 1}, 0, 1)); });
}

inline bool is_valid(Points points, const Hex &cell) {
    return kind_of(cell) == HEXAHEDRON ? SingleHex(points, cell).valid() : cell_quality(points, cell).valid;
}

}  // namespace hexmend
