// Symmetric 3 x 3 matrices.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "simd/vectors.hpp"

namespace hexmend {

// A symmetric matrix by its upper triangle.
struct SymmetricMatrix {
    double xx, xy, xz, yy, yz, zz;

    void add_to_diagonal(double shift) { xx += shift, yy += shift, zz += shift; }
};

// Smallest and largest eigenvalue.
struct Extremes {
    double smallest, largest;
};

// Smallest and largest eigenvalue, by the trigonometric solution of the characteristic equation (Smith 1961).
inline Extremes extreme_eigenvalues(const SymmetricMatrix &a) {
    double mean = (a.xx + a.yy + a.zz) / 3;
    double x = a.xx - mean, y = a.yy - mean, z = a.zz - mean;
    double spread = std::sqrt((x * x + y * y + z * z + 2 * (a.xy * a.xy + a.xz * a.xz + a.yz * a.yz)) / 6);
    if (!(spread > 0)) return {mean, mean};
    double half = (x * (y * z - a.yz * a.yz) - a.xy * (a.xy * z - a.yz * a.xz) + a.xz * (a.xy * a.yz - y * a.xz)) /
                  (2 * spread * spread * spread);
    double angle = std::acos(std::clamp(half, -1.0, 1.0)) / 3;
    return {mean + 2 * spread * std::cos(angle + 2 * std::numbers::pi / 3), mean + 2 * spread * std::cos(angle)};
}

inline SymmetricMatrix operator*(double k, const SymmetricMatrix &a) {
    return {k * a.xx, k * a.xy, k * a.xz, k * a.yy, k * a.yz, k * a.zz};
}

inline V3<double> operator*(const SymmetricMatrix &a, const V3<double> &v) {
    return {a.xx * v.x + a.xy * v.y + a.xz * v.z, a.xy * v.x + a.yy * v.y + a.yz * v.z,
            a.xz * v.x + a.yz * v.y + a.zz * v.z};
}

// Result of `adjugate_of`.
struct Adjugate {
    SymmetricMatrix adjugate;
    double det;
};

// The adjugate and the determinant; their quotient is the inverse.
inline Adjugate adjugate_of(const SymmetricMatrix &a) {
    double xx = a.yy * a.zz - a.yz * a.yz, xy = a.xz * a.yz - a.xy * a.zz, xz = a.xy * a.yz - a.xz * a.yy;
    double yy = a.xx * a.zz - a.xz * a.xz, yz = a.xy * a.xz - a.xx * a.yz, zz = a.xx * a.yy - a.xy * a.xy;
    return {{xx, xy, xz, yy, yz, zz}, a.xx * xx + a.xy * xy + a.xz * xz};
}

// Solution of the linear system; zero where the matrix is singular.
inline V3<double> solve(const SymmetricMatrix &a, const V3<double> &b) {
    auto [c, det] = adjugate_of(a);
    if (det == 0) return {};
    auto [x, y, z] = c * b;
    return {x / det, y / det, z / det};
}

}  // namespace hexmend
