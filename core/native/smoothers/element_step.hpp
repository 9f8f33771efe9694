// GETMe's element step, which makes one cell more regular.
//
// Corner k goes to c_k + s n_k/sqrt(|n_k|), centroid and outward normal of the triangle that the centroids of the three
// faces at k make in the dual octahedron; the hex is scaled about its centroid to its old mean edge length and blended
// with the old one by rho. Vartziotis and Wipper 2011, CMAME 200:1186; thesis 3.1.2.
#pragma once

#include "simd/simd_hexes.hpp"

namespace hexmend {

// The three faces at each corner of a tetrahedron, as `CORNER_FACES`.
constexpr int TETRAHEDRON_CORNER_FACES[4][3] = {{0, 1, 3}, {0, 2, 1}, {0, 3, 2}, {1, 2, 3}};

// Targets of the corners of a hex or a tetrahedron: scale s, blend rho in (0, 1]. Wedges and pyramids stay as they are.
template <class Cell, class T> inline Corners<T> element_step(const Corners<T> &x, double s, double rho) {
    constexpr int nodes = Cell::table.nodes, faces = Cell::table.faces;
    if constexpr (nodes == 6 || nodes == 5) return x;
    V3<T> f[faces], middle;
    unroll<faces>([&](auto i) {
        auto [a, b, c, d] = Cell::table.face_nodes[i];
        f[i] = Cell::is_cube ? broadcast<T>(0.25) * (x.at[a] + x.at[b] + x.at[c] + x.at[d])
                             : broadcast<T>(1.0 / 3.0) * (x.at[a] + x.at[b] + x.at[c]);
    });
    Corners<T> y;
    unroll<nodes>([&](auto k) {
        int a, b, c;
        if constexpr (Cell::is_cube) a = CORNER_FACES[k][0], b = CORNER_FACES[k][1], c = CORNER_FACES[k][2];
        else a = TETRAHEDRON_CORNER_FACES[k][0], b = TETRAHEDRON_CORNER_FACES[k][1], c = TETRAHEDRON_CORNER_FACES[k][2];
        auto n = cross(f[b] - f[a], f[c] - f[a]);
        T r = sqrt(length(n));
        T along = r > 0.0 ? s / r : broadcast<T>(0.0);
        y.at[k] = broadcast<T>(1.0 / 3.0) * (f[a] + f[b] + f[c]) + along * n;
        middle += broadcast<T>(1.0 / nodes) * y.at[k];
    });
    T before = edge_lengths<Cell>(x), after = edge_lengths<Cell>(y);
    T zeta = after > 0.0 ? before / after : broadcast<T>(0.0);
    for (int c = 0; c < nodes; ++c) y.at[c] = x.at[c] + broadcast<T>(rho) * (middle + zeta * (y.at[c] - middle) - x.at[c]);
    return y;
}

}  // namespace hexmend
