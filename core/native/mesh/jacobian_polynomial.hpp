// det J of a hex as a polynomial in Bernstein's form, and its subdivision.
#pragma once

#include <algorithm>
#include <vector>

#include "mesh/hexahedron.hpp"

namespace hexmend {

constexpr double binomial(int n, int k) { return k == 0 || k == n ? 1 : binomial(n - 1, k - 1) + binomial(n - 1, k); }

// Coefficients of a polynomial of three variables, `nx` x `ny` x `nz`: degrees nx - 1, ny - 1, nz - 1.
template <class V, int nx, int ny, int nz> struct Coefficients {
    V at[nx][ny][nz]{};
};

// Add the product of two polynomials in scaled form (each coefficient times its binomials) to `sum`.
template <class A, class B, class V, int ax, int ay, int az, int bx, int by, int bz, class Product>
inline __attribute__((always_inline)) void convolve(const Coefficients<A, ax, ay, az> &a,
                                                    const Coefficients<B, bx, by, bz> &b,
                                                    Coefficients<V, ax + bx - 1, ay + by - 1, az + bz - 1> &sum,
                                                    const Product &product) {
#pragma GCC unroll 2
    for (int i = 0; i < ax; ++i)
#pragma GCC unroll 2
        for (int j = 0; j < ay; ++j)
#pragma GCC unroll 2
            for (int k = 0; k < az; ++k)
#pragma GCC unroll 3
                for (int l = 0; l < bx; ++l)
#pragma GCC unroll 3
                    for (int m = 0; m < by; ++m)
#pragma GCC unroll 3
                        for (int n = 0; n < bz; ++n)
                            sum.at[i + l][j + m][k + n] += product(a.at[i][j][k], b.at[l][m][n]);
}

// det J of a map of degree d along each axis, and the largest product of the lengths of its columns, which its rounding
// errors are proportional to.
template <class T, int d> struct JacobianPolynomial {
    static constexpr int n = 3 * d;
    Coefficients<T, n, n, n> coefficients;
    T size;

    // `control` are the Bernstein coefficients of the map.
    explicit JacobianPolynomial(const Coefficients<V3<T>, d + 1, d + 1, d + 1> &control) {
        Coefficients<V3<T>, d, d + 1, d + 1> x;
        Coefficients<V3<T>, d + 1, d, d + 1> y;
        Coefficients<V3<T>, d + 1, d + 1, d> z;
        T longest[3] = {};
        auto put = [&](V3<T> &to, const V3<T> &ahead, const V3<T> &behind, T &largest, double scale) {
            V3<T> column = ahead - behind;
            largest = max(largest, square(column));
            to = broadcast<T>(d * scale) * column;
        };
        for (int i = 0; i <= d; ++i)
            for (int j = 0; j <= d; ++j)
                for (int k = 0; k <= d; ++k) {
                    auto &p = control.at;
                    double bi = binomial(d, i), bj = binomial(d, j), bk = binomial(d, k);
                    if (i < d) put(x.at[i][j][k], p[i + 1][j][k], p[i][j][k], longest[0], binomial(d - 1, i) * bj * bk);
                    if (j < d) put(y.at[i][j][k], p[i][j + 1][k], p[i][j][k], longest[1], bi * binomial(d - 1, j) * bk);
                    if (k < d) put(z.at[i][j][k], p[i][j][k + 1], p[i][j][k], longest[2], bi * bj * binomial(d - 1, k));
                }
        Coefficients<V3<T>, 2 * d + 1, 2 * d, 2 * d> normals;
        convolve(y, z, normals, [](const V3<T> &a, const V3<T> &b) { return cross(a, b); });
        convolve(x, normals, coefficients, [](const V3<T> &a, const V3<T> &b) { return dot(a, b); });
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                for (int k = 0; k < n; ++k)
                    coefficients.at[i][j][k] *= 1 / (binomial(n - 1, i) * binomial(n - 1, j) * binomial(n - 1, k));
        size = (d * d * d) * (sqrt(longest[0]) * sqrt(longest[1]) * sqrt(longest[2]));  // no overflow of the squares
    }
};

// A polynomial of degree n - 1 along each axis on a part of the unit cube.
template <int n> struct Box {
    std::array<double, n * n * n> coefficients;
    int level;  // halvings along each axis

    double least() const { return *std::min_element(coefficients.begin(), coefficients.end()); }

    // The value at corner c.
    double at_corner(int c) const {
        auto &[x, y, z] = UNIT_CUBE[c];
        return coefficients[(n - 1) * ((x * n + y) * n + z)];
    }
    double least_at_corners() const {
        double least = INF;
        for (int c = 0; c < 8; ++c) least = std::min(least, at_corner(c));
        return least;
    }
    bool positive_at_corners() const {
        bool all = true;
        for (int c = 0; c < 8; ++c) all &= at_corner(c) > 0;
        return all;
    }
    bool finite() const {
        return std::all_of(coefficients.begin(), coefficients.end(), [](double c) { return std::isfinite(c); });
    }

    // The half along an axis (0 to 2), the lower or the upper one: de Casteljau's scheme at 1/2.
    Box half(int axis, bool upper) const {
        Box part = *this;
        int step = axis == 0 ? n * n : axis == 1 ? n : 1;
        int across[2] = {axis == 0 ? n : n * n, axis == 2 ? n : 1};
        for (int a = 0; a < n; ++a)
            for (int b = 0; b < n; ++b) {
                double *row = part.coefficients.data() + a * across[0] + b * across[1];
                for (int round = 1; round < n; ++round) {
                    if (upper)
                        for (int k = 0; k < n - round; ++k) row[k * step] = 0.5 * (row[k * step] + row[(k + 1) * step]);
                    else
                        for (int k = n - 1; k >= round; --k)
                            row[k * step] = 0.5 * (row[k * step] + row[(k - 1) * step]);
                }
            }
        return part;
    }

    // Add its eight halves along all axes to `parts`.
    void halve(std::vector<Box> &parts) const {
        for (int part = 0; part < 8; ++part) {
            parts.push_back(half(0, part & 1).half(1, part & 2).half(2, part & 4));
            ++parts.back().level;
        }
    }
};

}  // namespace hexmend
