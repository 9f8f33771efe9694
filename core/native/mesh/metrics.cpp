#include "mesh/metrics.hpp"

#include "energy/tetrahedron.hpp"
#include "simd/simd_hexes.hpp"

namespace hexmend {
namespace {

// The smallest and largest distance of pairs of corners.
struct DistanceRange {
    Lanes least, greatest;
};

template <int n> DistanceRange distances(const Corners<Lanes> &x, const auto &pairs) {
    Lanes low = broadcast<Lanes>(INF), high{};
    unroll<n>([&](auto i) {
        Lanes d = square(x.at[pairs[i][1]] - x.at[pairs[i][0]]);
        low = min(d, low), high = max(d, high);
    });
    return {sqrt(low), sqrt(high)};
}

// A metric that is defined for hexes alone: no number for other cells.
template <class Cell> Lanes of_hexes(const Lanes &value) {
    return Cell::is_cube ? value : broadcast<Lanes>(std::numeric_limits<double>::quiet_NaN());
}

// Coordinate of a corner along x, y or z in the cube [-1, 1]^3.
constexpr int side(int corner, int axis) { return 2 * UNIT_CUBE[corner][axis] - 1; }

// Sum of the corners for which positive(c), minus the others.
template <class Positive> V3<Lanes> signed_sum(const Corners<Lanes> &x, Positive positive) {
    V3<Lanes> sum;
    unroll<8>([&](auto c) {
        if constexpr (positive(c)) sum += x.at[c];
        else sum -= x.at[c];
    });
    return sum;
}

// The principal axis X1, X2 or X3: the sum of the four edges along x, y or z, (6) of the manual.
template <int i> V3<Lanes> axis(const Corners<Lanes> &x) {
    return signed_sum(x, [](int c) { return side(c, i) > 0; });
}

// The cross derivative X12, X23 or X31, (8) of the manual.
template <int i> V3<Lanes> cross_derivative(const Corners<Lanes> &x) {
    return signed_sum(x, [](int c) { return side(c, i) * side(c, (i + 1) % 3) > 0; });
}

}  // namespace

void lengths(Points points, Hexes hexes, std::span<double> edge_ratio, std::span<double> stretch,
             std::span<double> diagonal) {
    expect(have_rows(hexes.size(), edge_ratio, stretch, diagonal),
           "edge_ratio, stretch and diagonal: one for each of hexes is expected");
    for_each_corners<Lanes>(points, hexes, [&](auto cell, const Corners<Lanes> &x, std::int64_t first, int count) {
        using Cell = decltype(cell);
        auto [shortest, longest] = distances<Cell::table.edges>(x, Cell::table.edge_ends);
        auto [narrow, wide] = distances<4>(x, DIAGONALS);
        store(shortest > 0.0 ? longest / shortest : broadcast<Lanes>(INF), first, count, edge_ratio);
        auto full = shortest > 0.0 ? ROOT_3 * shortest / wide : broadcast<Lanes>(0.0);
        store(of_hexes<Cell>(full), first, count, stretch);
        store(of_hexes<Cell>(wide > 0.0 ? narrow / wide : broadcast<Lanes>(0.0)), first, count, diagonal);
    });
}

void axes(Points points, Hexes hexes, std::span<double> aspect_ratio, std::span<double> skew, std::span<double> taper) {
    expect(have_rows(hexes.size(), aspect_ratio, skew, taper),
           "aspect_ratio, skew and taper: one for each of hexes is expected");
    for_each_block<Lanes>(hexes, [&](auto cell, std::int64_t first, int count) {
        using Cell = decltype(cell);
        auto x = from_first_corner(gather_corners<Lanes>(points, hexes, first, count));
        V3<Lanes> X[3] = {axis<0>(x), axis<1>(x), axis<2>(x)};
        Lanes crossing[3] = {length(cross_derivative<0>(x)), length(cross_derivative<1>(x)),
                             length(cross_derivative<2>(x))};
        Lanes l[3] = {length(X[0]), length(X[1]), length(X[2])};
        Lanes low = min(l[0], min(l[1], l[2])), high = max(l[0], max(l[1], l[2]));
        Lanes most_skew{}, most_taper{};
        unroll<3>([&](auto i) {
            constexpr int j = (i + 1) % 3;
            most_skew = max(abs(dot(X[i], X[j])) / (l[i] * l[j]), most_skew);
            most_taper = max(crossing[i] / min(l[i], l[j]), most_taper);
        });
        auto valid = (l[0] > 0.0) & (l[1] > 0.0) & (l[2] > 0.0) & (high < INF);
        store(of_hexes<Cell>(valid ? high / low : broadcast<Lanes>(INF)), first, count, aspect_ratio);
        auto skewed = valid ? min(most_skew, broadcast<Lanes>(1.0)) : broadcast<Lanes>(1.0);
        store(of_hexes<Cell>(skewed), first, count, skew);
        store(of_hexes<Cell>(valid ? most_taper : broadcast<Lanes>(INF)), first, count, taper);
    });
}

void corners(Points points, Hexes hexes, std::span<double> shape, std::span<double> condition) {
    expect(have_rows(hexes.size(), shape, condition), "shape and condition: one for each of hexes is expected");
    for_each_corners<Lanes>(points, hexes, [&](auto cell, const Corners<Lanes> &x, std::int64_t first, int count) {
        using Cell = decltype(cell);
        Lanes fullest = broadcast<Lanes>(INF), worst = broadcast<Lanes>(1.0);
        unroll<Cell::corners>([&](auto t) {
            auto s = x.template shape<Cell, t>();
            Lanes det = determinant(s);
            Lanes length = sqrt(square(s)), area = sqrt(square(cofactors(s)));  // |S|, |S^-1| det S
            auto valid = (det > 0.0) & (det < INF);
            fullest = min(valid ? det / (length * length * length) : broadcast<Lanes>(0.0), fullest);
            worst = max(valid ? length * area / (3.0 * det) : broadcast<Lanes>(INF), worst);
        });
        store(min(3.0 / power_minus_two_thirds(fullest), broadcast<Lanes>(1.0)), first, count, shape);
        store(worst, first, count, condition);
    });
}

void centre(Points points, Hexes hexes, std::span<double> jacobian) {
    expect(jacobian.size() == hexes.size(), "jacobian: one for each of hexes is expected");
    for_each_block<Lanes>(hexes, [&](auto cell, std::int64_t first, int count) {
        using Cell = decltype(cell);
        auto x = from_first_corner(gather_corners<Lanes>(points, hexes, first, count));
        Lanes det = determinant(M3<Lanes>{axis<0>(x), axis<1>(x), axis<2>(x)}) * (1.0 / 64);
        store(of_hexes<Cell>(det), first, count, jacobian);
    });
}

}  // namespace hexmend
