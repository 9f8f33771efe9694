// GETMe's element step, which makes one cell more regular.
//
// Corner k goes to c_k + s n_k/sqrt(|n_k|), centroid and outward normal of the triangle that the centroids of the three
// faces at k make in the dual octahedron; the hex is scaled about its centroid to its old mean edge length and blended
// with the old one by rho. Vartziotis and Wipper 2011, CMAME 200:1186; thesis 3.1.2. Other kinds of cells: Vartziotis
// and Himpel 2013, arXiv 1302.6066, the gradient flow of the volume.
#pragma once

#include "simd/simd_hexes.hpp"

namespace hexmend {

// Targets of the corners of a hex: scale s, blend rho in (0, 1].
template <class T> inline Corners<T> hex_step(const Corners<T> &x, double s, double rho) {
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

// The places of the nodes of other cells before scaling, and their mean: each goes along n_k, the derivative of the
// volume, by s n_k/sqrt(mean |n|). Where faces of different forms meet their shares are weighed, so that the ideal cell
// only grows: quads of a wedge by 2/3, that of a pyramid by 4/5, and all of the apex by 2/5.
template <class Cell, class T> inline Corners<T> regularised(const Corners<T> &x, double s, V3<T> &middle) {
    constexpr int nodes = Cell::table.nodes;
    Corners<T> n, y = x;
    unroll<Cell::table.faces>([&](auto f) {
        constexpr auto &face = Cell::table.face_nodes[f];
        constexpr int corners = face[2] == face[3] ? 3 : 4;
        constexpr double quads = nodes == 6 ? 2.0 / 3 : 0.8, share = (corners == 3 ? 0.5 : 0.5 * quads) / corners;
        auto area = cross(x.at[face[2]] - x.at[face[0]], x.at[face[3]] - x.at[face[1]]);
        for (int k = 0; k < corners; ++k) n.at[face[k]] += broadcast<T>(share) * area;
    });
    if constexpr (nodes == 5) n.at[4] = broadcast<T>(0.4) * n.at[4];
    T mean{};
    for (int k = 0; k < nodes; ++k) mean += (1.0 / nodes) * length(n.at[k]);
    T along = mean > 0.0 ? s / sqrt(mean) : broadcast<T>(0.0);
    for (int k = 0; k < nodes; ++k) y.at[k] += along * n.at[k], middle += broadcast<T>(1.0 / nodes) * y.at[k];
    return y;
}

// Targets of the nodes of any cell.
template <class Cell, class T> inline Corners<T> element_step(const Corners<T> &x, double s, double rho) {
    if constexpr (Cell::is_cube) return hex_step(x, s, rho);
    constexpr int nodes = Cell::table.nodes;
    V3<T> middle;
    Corners<T> y = regularised<Cell>(x, s, middle);
    T before = edge_lengths<Cell>(x), after = edge_lengths<Cell>(y);
    T zeta = after > 0.0 ? before / after : broadcast<T>(0.0);
    for (int c = 0; c < nodes; ++c)
        y.at[c] = x.at[c] + broadcast<T>(rho) * (middle + zeta * (y.at[c] - middle) - x.at[c]);
    return y;
}

}  // namespace hexmend
