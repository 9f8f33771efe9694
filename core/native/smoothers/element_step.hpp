// GETMe's element step, which makes one hex more regular.
//
// Corner k goes to c_k + s n_k/sqrt(|n_k|), centroid and outward normal of the triangle that the centroids of the three
// faces at k make in the dual octahedron; the hex is scaled about its centroid to its old mean edge length and blended
// with the old one by rho. Vartziotis and Wipper 2011, CMAME 200:1186; thesis 3.1.2.
#pragma once

#include "simd/simd_hexes.hpp"

namespace hexmend {

// Targets of the corners of a hex: scale s, blend rho in (0, 1].
template <class T> inline Corners<T> element_step(const Corners<T> &x, double s, double rho) {
    V3<T> f[6], middle;
    unroll<6>([&](auto i) {
        auto [a, b, c, d] = FACES[i];
        f[i] = broadcast<T>(0.25) * (x.at[a] + x.at[b] + x.at[c] + x.at[d]);
    });
    Corners<T> y;
    unroll<8>([&](auto k) {
        auto [a, b, c] = CORNER_FACES[k];
        auto n = cross(f[b] - f[a], f[c] - f[a]);
        T r = sqrt(length(n));
        T along = r > 0.0 ? s / r : broadcast<T>(0.0);
        y.at[k] = broadcast<T>(1.0 / 3.0) * (f[a] + f[b] + f[c]) + along * n;
        middle += broadcast<T>(0.125) * y.at[k];
    });
    T before = edge_lengths(x), after = edge_lengths(y);
    T zeta = after > 0.0 ? before / after : broadcast<T>(0.0);
    for (int c = 0; c < 8; ++c) y.at[c] = x.at[c] + broadcast<T>(rho) * (middle + zeta * (y.at[c] - middle) - x.at[c]);
    return y;
}

}  // namespace hexmend
