// The reference hexahedron, numbered as `hexmend.mesh.hexahedron` draws it, and the other kinds of cells.
#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "simd/vectors.hpp"

namespace hexmend {

constexpr double ROOT_2 = 1.4142135623730951, ROOT_3 = 1.7320508075688772, ROOT_6 = 2.449489742783178;

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

// A kind of cells: what is listed of each is numbered by its own nodes, in the order of VTK. A triangle is a quad whose
// last two nodes are one. With W the edges of the ideal cell at each of its corner tetrahedra, S W^-1 takes the place
// of S: `inverse` is W^-1, upper triangular, and its determinant is 1 over the scaled Jacobian of the ideal cell.
struct CellTable {
    int nodes, corners, edges, faces;
    int corner_tetrahedra[8][4], edge_ends[12][2], face_nodes[6][4];
    double inverse[3][3];

    constexpr double inverse_determinant() const { return inverse[0][0] * inverse[1][1] * inverse[2][2]; }
};

enum CellKind { HEXAHEDRON, WEDGE, PYRAMID, TETRAHEDRON, CELL_KINDS };

// The ideal cells: a cube, an equilateral triangle extruded by its edge, a pyramid of equal edges, a regular
// tetrahedron.
inline constexpr CellTable CELL_TABLES[CELL_KINDS] = {
    {8,
     8,
     12,
     6,
     {{0, 3, 4, 1}, {1, 0, 5, 2}, {2, 1, 6, 3}, {3, 2, 7, 0}, {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}},
     {{0, 1}, {3, 2}, {4, 5}, {7, 6}, {0, 3}, {1, 2}, {4, 7}, {5, 6}, {0, 4}, {1, 5}, {3, 7}, {2, 6}},
     {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}},
     {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
    {6,
     6,
     9,
     5,
     {{0, 1, 2, 3}, {1, 2, 0, 4}, {2, 0, 1, 5}, {3, 5, 4, 0}, {4, 3, 5, 1}, {5, 4, 3, 2}},
     {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}},
     {{0, 2, 1, 1}, {3, 4, 5, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}},
     {{1, -1 / ROOT_3, 0}, {0, 2 / ROOT_3, 0}, {0, 0, 1}}},
    {5,
     4,
     8,
     5,
     {{0, 1, 3, 4}, {1, 2, 0, 4}, {2, 3, 1, 4}, {3, 0, 2, 4}},
     {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}},
     {{0, 3, 2, 1}, {0, 1, 4, 4}, {1, 2, 4, 4}, {2, 3, 4, 4}, {3, 0, 4, 4}},
     {{1, 0, -ROOT_2 / 2}, {0, 1, -ROOT_2 / 2}, {0, 0, ROOT_2}}},
    {4,
     4,
     6,
     4,
     {{0, 1, 2, 3}, {1, 2, 0, 3}, {2, 0, 1, 3}, {3, 1, 0, 2}},
     {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
     {{0, 2, 1, 1}, {0, 1, 3, 3}, {1, 2, 3, 3}, {2, 0, 3, 3}},
     {{1, -1 / ROOT_3, -1 / ROOT_6}, {0, 2 / ROOT_3, -1 / ROOT_6}, {0, 0, ROOT_6 / 2}}},
};

// The kind of a row of eight nodes: that of fewer nodes is padded by its last one.
inline CellKind kind_of(const Hex &row) {
    if (row[6] != row[7] || row[5] != row[6]) [[likely]]
        return HEXAHEDRON;
    if (row[4] != row[5]) return WEDGE;
    if (row[3] != row[4]) return PYRAMID;
    return row[2] != row[3] ? TETRAHEDRON : HEXAHEDRON;
}

inline const CellTable &table_of(const Hex &row) { return CELL_TABLES[kind_of(row)]; }

// A kind as a type.
template <CellKind kind> struct Cell {
    static constexpr const CellTable &table = CELL_TABLES[kind];
    static constexpr bool is_cube = kind == HEXAHEDRON;
    static constexpr int corners = table.corners;
    static constexpr double share = 1.0 / table.corners;  // of each corner in a mean
    static constexpr double share_of_eighths = 8.0 / table.corners;
    static constexpr double inverse_determinant = table.inverse_determinant();
};

using Hexahedron = Cell<HEXAHEDRON>;

// Call body(cell) with the kind of a row.
template <class Body> inline __attribute__((always_inline)) auto with_kind(const Hex &row, const Body &body) {
    switch (kind_of(row)) {
        case WEDGE:
            return body(Cell<WEDGE>{});
        case PYRAMID:
            return body(Cell<PYRAMID>{});
        case TETRAHEDRON:
            return body(Cell<TETRAHEDRON>{});
        default:
            return body(Hexahedron{});
    }
}

// Of hexes. Corner tetrahedra (a, b, c, d), apex a first: det [x_b - x_a, x_c - x_a, x_d - x_a] = +1 on the unit cube,
// Table 2.1; four edges along x, four along y, four along z; faces seen counter-clockwise from outside: x-, x+, y-, y+,
// z-, z+.
inline constexpr auto &CORNER_TETRAHEDRA = Hexahedron::table.corner_tetrahedra;
inline constexpr auto &EDGES = Hexahedron::table.edge_ends;
inline constexpr auto &FACES = Hexahedron::table.face_nodes;
constexpr int DIAGONALS[4][2] = {{0, 6}, {1, 7}, {2, 4}, {3, 5}};

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

// S W^-1 of a kind of cells.
template <class Cell, class T> inline __attribute__((always_inline)) M3<T> with_ideal(const M3<T> &s) {
    if constexpr (Cell::is_cube) return s;
    constexpr auto &v = Cell::table.inverse;
    auto times = [](double factor, const V3<T> &column) { return broadcast<T>(factor) * column; };
    return {s.u, times(v[0][1], s.u) + times(v[1][1], s.v),
            times(v[0][2], s.u) + times(v[1][2], s.v) + times(v[2][2], s.w)};
}

// A derivative by S from that by S W^-1.
template <class Cell, class T> inline __attribute__((always_inline)) M3<T> by_edges(const M3<T> &g) {
    if constexpr (Cell::is_cube) return g;
    constexpr auto &v = Cell::table.inverse;
    auto times = [](double factor, const V3<T> &column) { return broadcast<T>(factor) * column; };
    return {g.u + times(v[0][1], g.v) + times(v[0][2], g.w), times(v[1][1], g.v) + times(v[1][2], g.w),
            times(v[2][2], g.w)};
}

// A vector at each of the eight corners.
template <class T> struct Corners {
    V3<T> at[8];

    // The columns of S at corner tetrahedron t of a kind of cells: edges from its apex.
    template <class Cell, int t> M3<T> edges() const {
        constexpr auto &n = Cell::table.corner_tetrahedra[t];
        return {at[n[1]] - at[n[0]], at[n[2]] - at[n[0]], at[n[3]] - at[n[0]]};
    }
    template <int t> M3<T> edges() const { return edges<Hexahedron, t>(); }

    // S W^-1 there.
    template <class Cell, int t> M3<T> shape() const { return with_ideal<Cell>(edges<Cell, t>()); }

    // Add a derivative by the columns of S to the nodes that make them.
    template <class Cell, int t> void scatter(const M3<T> &g) {
        constexpr auto &n = Cell::table.corner_tetrahedra[t];
        at[n[1]] += g.u;
        at[n[2]] += g.v;
        at[n[3]] += g.w;
        at[n[0]] -= g.u + g.v + g.w;
    }
};

// Sum of the lengths of a cell's edges.
template <class Cell = Hexahedron, class T> inline T edge_lengths(const Corners<T> &x) {
    T total{};
    constexpr auto &ends = Cell::table.edge_ends;
    unroll<Cell::table.edges>([&](auto e) { total += length(x.at[ends[e][1]] - x.at[ends[e][0]]); });
    return total;
}

}  // namespace hexmend
