// Symmetric 3 x 3 matrices.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "vectors.hpp"

namespace hexmend {

struct Symmetric {
    double xx, xy, xz, yy, yz, zz;

    void raise(double shift) { xx += shift, yy += shift, zz += shift; }
};

struct Extremes {
    double least, greatest;
};

// Least and greatest eigenvalue, by the trigonometric solution of the characteristic equation (Smith 1961).
inline Extremes extreme_eigenvalues(const Symmetric &a) {
    double mean = (a.xx + a.yy + a.zz) / 3;
    double x = a.xx - mean, y = a.yy - mean, z = a.zz - mean;
    double spread = std::sqrt((x * x + y * y + z * z + 2 * (a.xy * a.xy + a.xz * a.xz + a.yz * a.yz)) / 6);
    if (!(spread > 0)) return {mean, mean};
    double half = (x * (y * z - a.yz * a.yz) - a.xy * (a.xy * z - a.yz * a.xz) + a.xz * (a.xy * a.yz - y * a.xz)) /
                  (2 * spread * spread * spread);
    double angle = std::acos(std::clamp(half, -1.0, 1.0)) / 3;
    return {mean + 2 * spread * std::cos(angle + 2 * std::numbers::pi / 3), mean + 2 * spread * std::cos(angle)};
}

// Solution of the linear system by cofactors; zero where the matrix is singular.
inline V3<double> solve(const Symmetric &a, const V3<double> &b) {
    double cxx = a.yy * a.zz - a.yz * a.yz, cxy = a.xz * a.yz - a.xy * a.zz, cxz = a.xy * a.yz - a.xz * a.yy;
    double det = a.xx * cxx + a.xy * cxy + a.xz * cxz;
    if (det == 0) return {};
    double cyy = a.xx * a.zz - a.xz * a.xz, cyz = a.xy * a.xz - a.xx * a.yz, czz = a.xx * a.yy - a.xy * a.xy;
    return {(cxx * b.x + cxy * b.y + cxz * b.z) / det, (cxy * b.x + cyy * b.y + cyz * b.z) / det,
            (cxz * b.x + cyz * b.y + czz * b.z) / det};
}

}  // namespace hexmend
