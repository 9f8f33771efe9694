#include "mesh/validity.hpp"

#include "mesh/jacobian_polynomial.hpp"
#include "simd/simd_hexes.hpp"

namespace hexmend {
namespace {

// Halvings of a hex along each axis after which it is undecided, and most boxes that are halved: where det J touches 0
// along a line or a surface there would be any number of them.
constexpr int MAX_LEVEL = 12;
constexpr std::size_t MAX_BOXES = 4096;
// Rounding errors of coefficients, as a share of the product of the columns' lengths: some ten roundings.
constexpr double ROUNDING = 16 * std::numeric_limits<double>::epsilon();
// Shares of the extreme and of the greatest coefficient by which a bound may differ from the extreme.
constexpr double BOUND_SHARE = 0.01, BOUND_SCALE = 1e-7;

// The map of a hex by its corners: x slowest, z fastest.
template <class T> Coefficients<V3<T>, 2, 2, 2> control_points(const Corners<T> &x) {
    Coefficients<V3<T>, 2, 2, 2> control;
    for (int c = 0; c < 8; ++c) control.at[UNIT_CUBE[c][0]][UNIT_CUBE[c][1]][UNIT_CUBE[c][2]] = x.at[c];
    return control;
}

// det J of a hex; at its corners with the sign that `determinant` has in every other kernel.
template <class T> JacobianPolynomial<T, 1> jacobian_polynomial(const Corners<T> &x) {
    JacobianPolynomial<T, 1> jacobian(control_points(x));
    unroll<8>([&](auto c) {
        constexpr auto &at = UNIT_CUBE[c];
        jacobian.coefficients.at[2 * at[0]][2 * at[1]][2 * at[2]] = determinant(x.template edges<c>());
    });
    return jacobian;
}

// det J of a hex of 27 nodes. Bernstein coefficients of a parabola are its ends, and twice its middle less their mean.
JacobianPolynomial<double, 2> jacobian_polynomial(const std::array<double, 81> &nodes) {
    Coefficients<V3<double>, 3, 3, 3> control;
    auto *p = &control.at[0][0][0];
    double extent = 0;  // from the first node, so that sums are not rounded at the size of the coordinates
    for (int i = 0; i < 27; ++i) {
        p[i] = {nodes[3 * i] - nodes[0], nodes[3 * i + 1] - nodes[1], nodes[3 * i + 2] - nodes[2]};
        extent = std::max(extent, length(p[i]));
    }
    for (int step : {9, 3, 1})
        for (int i = 0; i < 27; ++i)
            if (i / step % 3 == 1) p[i] = 2.0 * p[i] - 0.5 * (p[i - step] + p[i + step]);
    JacobianPolynomial<double, 2> jacobian(control);
    jacobian.size = 8 * extent * extent * extent;  // the columns of a thin hex are rounded at its extent
    return jacobian;
}

// det J of other cells, by what is sure to have its signs. A tetrahedron has one value. That of a pyramid is, over the
// square of the height that remains, a polynomial of degree 2 along both directions of the base. That of a wedge is
// linear over the triangle and of degree 2 along the extrusion: over the square that the triangle's corners and the
// first of them span it is bilinear, with the same extremes.
template <class Cell, class T> JacobianPolynomial<T, 1> jacobian_polynomial_of(const Corners<T> &x) {
    if constexpr (Cell::is_cube) return jacobian_polynomial(x);
    JacobianPolynomial<T, 1> jacobian(control_points(x));  // its size is that of a hex with all these nodes
    auto &at = jacobian.coefficients.at;
    auto fill = [&](auto &&value) {
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                for (int k = 0; k < 3; ++k) at[i][j][k] = value(i, j, k);
    };
    auto corner = [&](auto t) { return determinant(x.template edges<Cell, t>()); };
    if constexpr (Cell::table.nodes == 4) {
        T whole = corner(constant<0>{});
        fill([&](int, int, int) { return whole; });
    } else if constexpr (Cell::table.nodes == 5) {
        // Base edges along u at v = 0, 1, along v at u = 0, 1, and edges to the apex: det [B_u, B_v, A - B].
        auto &[a, b, c, d, top, p5, p6, p7] = x.at;
        V3<T> along_u[2] = {b - a, c - d}, along_v[2] = {d - a, c - b},
              up[2][2] = {{top - a, top - d}, {top - b, top - c}};
        T sum[3][3] = {};
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j) {
                V3<T> normal = cross(along_u[j], along_v[i]);
                for (int k = 0; k < 2; ++k)
                    for (int l = 0; l < 2; ++l) sum[i + k][j + l] += dot(normal, up[k][l]);
            }
        auto binomials = [](int i) { return i == 1 ? 0.5 : 1.0; };
        fill([&](int i, int j, int) { return sum[i][j] * (binomials(i) * binomials(j)); });
        at[0][0][0] = at[0][0][1] = at[0][0][2] = corner(constant<0>{});
        at[2][0][0] = at[2][0][1] = at[2][0][2] = corner(constant<1>{});
        at[2][2][0] = at[2][2][1] = at[2][2][2] = corner(constant<2>{});
        at[0][2][0] = at[0][2][1] = at[0][2][2] = corner(constant<3>{});
    } else {
        auto &[a, b, c, d, e, f, p6, p7] = x.at;
        V3<T> along_u[2] = {b - a, e - d}, along_v[2] = {c - a, f - d}, up[3] = {d - a, e - b, f - c};
        T first[3] = {corner(constant<0>{}), corner(constant<1>{}), corner(constant<2>{})};
        T last[3] = {corner(constant<3>{}), corner(constant<4>{}), corner(constant<5>{})};
        T value[3][3];
        for (int t = 0; t < 3; ++t) {
            V3<T> middle = cross(along_u[0], along_v[1]) + cross(along_u[1], along_v[0]);
            value[t][0] = first[t], value[t][1] = 0.5 * dot(middle, up[t]), value[t][2] = last[t];
        }
        constexpr double weights[3][2] = {{1, 0}, {0.5, 0.5}, {0, 1}};  // of a linear function's ends at degree 2
        fill([&](int i, int j, int k) {
            T low = weights[i][0] * value[0][k] + weights[i][1] * value[1][k];
            T high = weights[i][0] * value[2][k] + weights[i][1] * value[0][k];
            return weights[j][0] * low + weights[j][1] * high;
        });
    }
    return jacobian;
}

// The coefficients of hex number `lane` of a block.
template <int n, class T> Box<n> box(const Coefficients<T, n, n, n> &of, int lane) {
    Box<n> whole{{}, 0};
    for (int i = 0; i < n * n * n; ++i) whole.coefficients[i] = hexmend::lane((&of.at[0][0][0])[i], lane);
    return whole;
}

template <int n> Validity decide(const Box<n> &whole, double margin) {
    if (!whole.positive_at_corners()) return INVERTED;
    if (!whole.finite()) return UNDECIDED;
    Validity found = VALID;
    std::vector<Box<n>> open{whole};  // depth first
    for (std::size_t boxes = 0; !open.empty(); ++boxes) {
        Box<n> box = open.back();
        open.pop_back();
        if (box.least() > margin) continue;
        if (!box.positive_at_corners()) return INVALID_INSIDE;
        if (boxes >= MAX_BOXES || box.level >= MAX_LEVEL) found = UNDECIDED;
        else box.halve(open);
    }
    return found;
}

// A lower bound of the least value. All boxes of a level are compared with the same value, so that the bound does not
// depend on the corner at which the numbering of the hex begins.
template <int n> double least_value(const Box<n> &whole) {
    double scale = 0, bound = INF, value = INF;  // a value that is taken, which the least is no greater than
    for (double c : whole.coefficients) scale = std::max(scale, std::abs(c));
    if (!whole.finite()) return -INF;
    std::vector<Box<n>> open{whole}, halved;
    for (int level = 0; !open.empty(); ++level) {
        for (const auto &box : open) value = std::min(value, box.least_at_corners());
        double near = value - std::max(BOUND_SHARE * std::abs(value), BOUND_SCALE * scale);
        bool last = level == MAX_LEVEL || open.size() > MAX_BOXES;
        halved.clear();
        for (const auto &box : open) {
            if (last || box.least() >= near) bound = std::min(bound, box.least());
            else box.halve(halved);
        }
        open.swap(halved);
    }
    return bound;
}

template <int n> std::array<double, 2> bounds_of(Box<n> whole) {
    double least = least_value(whole);
    for (double &c : whole.coefficients) c = -c;
    return {least, -least_value(whole)};
}

// A lower bound of the least value over the greatest, or over the least itself where that is larger: from -1 to 1. They
// are at least `low`, at most `high`, and `taken` is a value.
double ratio(double low, double high, double taken) {
    if (!(std::abs(low) < INF && std::abs(high) < INF)) return -1;
    if (low >= 0) return high > 0 ? low / high : 0.0;
    return low / std::max(-low, taken);
}

// Lower `lowest` to the ratio of a hex, which is computed only where its coefficients allow it to be lower.
template <int n> void lower(double &lowest, const Box<n> &whole) {
    double taken = whole.at_corner(0);
    for (int c = 1; c < 8; ++c) taken = std::max(taken, whole.at_corner(c));
    auto [least, greatest] = std::minmax_element(whole.coefficients.begin(), whole.coefficients.end());
    if (whole.finite() && ratio(*least, *greatest, taken) >= lowest) return;
    auto [low, high] = bounds_of(whole);
    lowest = std::min(lowest, ratio(low, high, taken));
}

// Call body(number of the hex, its box, the rounding error of its coefficients) for hexes of 27 nodes.
template <class Body> void for_each_quadratic(QuadraticHexes nodes, const Body &body) {
    parallel_chunks(nodes.size(), HEXES_PER_CHUNK, [&](std::int64_t begin, std::int64_t end) {
        for (auto h = begin; h < end; ++h) {
            auto jacobian = jacobian_polynomial(nodes[h]);
            body(h, box<6>(jacobian.coefficients, 0), ROUNDING * jacobian.size);
        }
    });
}

}  // namespace

void certify(Points points, Hexes hexes, std::span<std::uint8_t> validity) {
    expect(validity.size() == hexes.size(), "validity: a number for each of the hexes is expected");
    for_each_block<Lanes>(hexes, [&](auto cell, std::int64_t first, int count) {
        auto jacobian = jacobian_polynomial_of<decltype(cell)>(gather_corners<Lanes>(points, hexes, first, count));
        const Lanes *values = &jacobian.coefficients.at[0][0][0];
        Lanes least = values[0], margin = ROUNDING * jacobian.size;
        for (int i = 1; i < 27; ++i) least = min(values[i], least);
        for (int i = 0; i < count; ++i)
            validity[first + i] = least[i] > margin[i] ? VALID : decide(box<3>(jacobian.coefficients, i), margin[i]);
    });
}

void certify_quadratic(QuadraticHexes nodes, std::span<std::uint8_t> validity) {
    expect(validity.size() == nodes.size(), "validity: a number for each of the hexes is expected");
    for_each_quadratic(nodes,
                       [&](std::int64_t h, const Box<6> &box, double margin) { validity[h] = decide(box, margin); });
}

void jacobian_bounds(Points points, Hexes hexes, ArrayView<double, 2> bounds) {
    expect(bounds.size() == hexes.size(), "bounds: a row of each of the hexes is expected");
    for_each_block<Lanes>(hexes, [&](auto cell, std::int64_t first, int count) {
        auto jacobian = jacobian_polynomial_of<decltype(cell)>(gather_corners<Lanes>(points, hexes, first, count));
        for (int i = 0; i < count; ++i) bounds[first + i] = bounds_of(box<3>(jacobian.coefficients, i));
    });
}

void jacobian_bounds_quadratic(QuadraticHexes nodes, ArrayView<double, 2> bounds) {
    expect(bounds.size() == nodes.size(), "bounds: a row of each of the hexes is expected");
    for_each_quadratic(nodes, [&](std::int64_t h, const Box<6> &box, double) { bounds[h] = bounds_of(box); });
}

double least_jacobian(Points points, Hexes hexes) {
    std::vector<double> lowest(hexes.size() / HEXES_PER_CHUNK + 1, 1.0);
    for_each_block<Lanes>(hexes, [&](auto cell, std::int64_t first, int count) {
        auto jacobian = jacobian_polynomial_of<decltype(cell)>(gather_corners<Lanes>(points, hexes, first, count));
        for (int i = 0; i < count; ++i) lower(lowest[first / HEXES_PER_CHUNK], box<3>(jacobian.coefficients, i));
    });
    return *std::min_element(lowest.begin(), lowest.end());
}

double least_jacobian_quadratic(QuadraticHexes nodes) {
    std::vector<double> lowest(nodes.size() / HEXES_PER_CHUNK + 1, 1.0);
    for_each_quadratic(nodes,
                       [&](std::int64_t h, const Box<6> &box, double) { lower(lowest[h / HEXES_PER_CHUNK], box); });
    return *std::min_element(lowest.begin(), lowest.end());
}

void jacobian_coefficients(Points points, Hexes hexes, ArrayView<double, 27> coefficients) {
    expect(coefficients.size() == hexes.size(), "coefficients: a row of each of the hexes is expected");
    for_each_block<Lanes>(hexes, [&](auto cell, std::int64_t first, int count) {
        auto jacobian = jacobian_polynomial_of<decltype(cell)>(gather_corners<Lanes>(points, hexes, first, count));
        for (int i = 0; i < count; ++i) coefficients[first + i] = box<3>(jacobian.coefficients, i).coefficients;
    });
}

}  // namespace hexmend
