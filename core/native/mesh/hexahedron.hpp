// The reference hexahedron, numbered as `hexmend.mesh.hexahedron` draws it.
#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "simd/vectors.hpp"

namespace hexmend {

using Node = std::int32_t;
using Hex = std::array<Node, 8>;
using Point = std::array<double, 3>;

inline V3<double> vector(const Point &p) { return {p[0], p[1], p[2]}; }
inline Point point(const V3<double> &v) { return {v.x, v.y, v.z}; }

// v divided by its length; 0 for 0.
inline Point unit(const V3<double> &v) {
    const double size = length(v);
    return size > 0 ? point((1 / size) * v) : Point{};
}

// Corner tetrahedra (a, b, c, d), apex a first: det [x_b - x_a, x_c - x_a, x_d - x_a] = +1 on the unit cube, Table 2.1.
constexpr int CORNER_TETRAHEDRA[8][4] = {
    {0, 3, 4, 1}, {1, 0, 5, 2}, {2, 1, 6, 3}, {3, 2, 7, 0}, {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3},
};

// Four edges along x, four along y, four along z.
constexpr int EDGES[12][2] = {
    {0, 1}, {3, 2}, {4, 5}, {7, 6}, {0, 3}, {1, 2}, {4, 7}, {5, 6}, {0, 4}, {1, 5}, {3, 7}, {2, 6},
};

constexpr int DIAGONALS[4][2] = {{0, 6}, {1, 7}, {2, 4}, {3, 5}};

// Each seen counter-clockwise from outside: x-, x+, y-, y+, z-, z+.
constexpr int FACES[6][4] = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};

// Corner coordinates of the unit cube.
constexpr int UNIT_CUBE[8][3] = {
    {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1},
};

// The three faces (i, j, k) that meet at each corner: the normal of their centroids' triangle points outward.
constexpr auto CORNER_FACES = [] {
    std::array<std::array<int, 3>, 8> faces{};
    for (int c = 0; c < 8; ++c) {
        auto [x, y, z] = UNIT_CUBE[c];
        bool mirrored = (x + y + z) % 2 == 0;
        faces[c] = {x, mirrored ? z + 4 : y + 2, mirrored ? y + 2 : z + 4};
    }
    return faces;
}();

namespace detail {

constexpr int corner_at(int x, int y, int z) {
    for (int c = 0; c < 8; ++c)
        if (UNIT_CUBE[c][0] == x && UNIT_CUBE[c][1] == y && UNIT_CUBE[c][2] == z) return c;
    return -1;
}

// Corner numbers of a hex after the rotation that makes `corner` its corner 0.
constexpr std::array<int, 8> rotated_corners(int corner) {
    std::array<int, 8> places{};
    for (int c = 0; c < 8; ++c) {
        int at[3] = {};
        for (int k = 0; k < 3; ++k) {
            // Corner 0 has its neighbours along y, z and x.
            auto along = [&](int j) { return UNIT_CUBE[CORNER_TETRAHEDRA[corner][j]][k] - UNIT_CUBE[corner][k]; };
            at[k] = UNIT_CUBE[corner][k] + UNIT_CUBE[c][1] * along(1) + UNIT_CUBE[c][2] * along(2) +
                    UNIT_CUBE[c][0] * along(3);
        }
        places[c] = corner_at(at[0], at[1], at[2]);
    }
    return places;
}

}  // namespace detail

// Corner numbers of a hex after the rotation that makes corner c its corner 0: corner k becomes ROTATIONS[c][k].
alignas(32) constexpr std::array<std::array<int, 8>, 8> ROTATIONS = [] {
    std::array<std::array<int, 8>, 8> all{};
    for (int c = 0; c < 8; ++c) all[c] = detail::rotated_corners(c);
    return all;
}();

// Call body(constant<0>{}), ..., body(constant<n - 1>{}): an unrolled loop with a compile-time index.
template <int n> using constant = std::integral_constant<int, n>;
template <int n, class Body> inline __attribute__((always_inline)) void unroll(Body &&body) {
    [&]<int... i>(std::integer_sequence<int, i...>)
        __attribute__((always_inline)) { (body(constant<i>{}), ...); }(std::make_integer_sequence<int, n>{});
}

// A vector at each of the eight corners.
template <class T> struct Corners {
    V3<T> at[8];

    // The columns of S at corner tetrahedron t: edges from its apex.
    template <int t> M3<T> edges() const {
        constexpr auto &n = CORNER_TETRAHEDRA[t];
        return {at[n[1]] - at[n[0]], at[n[2]] - at[n[0]], at[n[3]] - at[n[0]]};
    }

    // Add a derivative by the columns of S to the nodes that make them.
    template <int t> void scatter(const M3<T> &g) {
        constexpr auto &n = CORNER_TETRAHEDRA[t];
        at[n[1]] += g.u;
        at[n[2]] += g.v;
        at[n[3]] += g.w;
        at[n[0]] -= g.u + g.v + g.w;
    }
};

// Sum of the lengths of the twelve edges.
template <class T> inline T edge_lengths(const Corners<T> &x) {
    T total{};
    unroll<12>([&](auto e) { total += length(x.at[EDGES[e][1]] - x.at[EDGES[e][0]]); });
    return total;
}

}  // namespace hexmend
