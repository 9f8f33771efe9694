// Scaling by a target (target.hpp): W^-1 scales the columns of S, and derivatives by S W^-1 are scaled back by the same
// factors. Kernels are templates over the target: for `Cubes` nothing is computed.
#pragma once

#include "energy/target.hpp"
#include "simd/simd_hexes.hpp"

namespace hexmend {

// Direction of the hex (0, 1, 2: x, y, z of its numbering) of the edge between two corners.
constexpr int direction_of(int a, int b) {
    for (int k = 0; k < 3; ++k)
        if (UNIT_CUBE[a][k] != UNIT_CUBE[b][k]) return k;
    return -1;
}

// Directions of the columns of S at each corner tetrahedron.
constexpr auto COLUMN_DIRECTIONS = [] {
    std::array<std::array<int, 3>, 8> directions{};
    for (int t = 0; t < 8; ++t)
        for (int k = 0; k < 3; ++k)
            directions[t][k] = direction_of(CORNER_TETRAHEDRA[t][0], CORNER_TETRAHEDRA[t][k + 1]);
    return directions;
}();

// Former directions of what are x, y, z after the rotation that makes a corner the corner 0; see ROTATIONS.
constexpr auto ROTATED_DIRECTIONS = [] {
    std::array<std::array<int, 3>, 8> directions{};
    for (int c = 0; c < 8; ++c)
        directions[c] = {direction_of(c, ROTATIONS[c][1]), direction_of(c, ROTATIONS[c][3]),
                         direction_of(c, ROTATIONS[c][4])};
    return directions;
}();

// W = 1 at a corner tetrahedron, or for hexes.
struct Unscaled {
    static constexpr bool scaled = false;
    template <class Cell, int t> Unscaled columns() const { return {}; }
};

// Factors of the columns of S at a corner tetrahedron, and the weight of the size.
template <class T> struct ColumnScales {
    static constexpr bool scaled = true;
    T u, v, w;
    double size_weight;
};

// Inverse target lengths of hexes along x, y and z; of other cells, of the columns of S W^-1 at every corner.
template <class T> struct HexScales {
    static constexpr bool scaled = true;
    V3<T> inverse;
    double size_weight;

    template <class Cell, int t> ColumnScales<T> columns() const {
        if constexpr (!Cell::is_cube) return {inverse.x, inverse.y, inverse.z, size_weight};
        constexpr auto d = COLUMN_DIRECTIONS[t];
        return {along<d[0]>(), along<d[1]>(), along<d[2]>(), size_weight};
    }

    template <int direction> T along() const {
        return direction == 0 ? inverse.x : direction == 1 ? inverse.y : inverse.z;
    }
};

// `Unscaled` or `HexScales`, as the target needs it.
template <class T, class Target>
using ScalesOf = std::conditional_t<std::is_same_v<Target, Cubes>, Unscaled, HexScales<T>>;

// Of the hexes of a block: row(i) is the number of the hex in lane i.
template <class T, class Row> inline Unscaled scales_of(const Cubes &, const Row &) { return {}; }
template <class T, class Row> inline HexScales<T> scales_of(const TargetMatrices &target, const Row &row) {
    return {load_lanes<T>([&](int i) -> const Point & { return target.inverse_lengths[row(i)]; }), target.size_weight};
}

// Of `count` hexes from number `first` on; unused lanes repeat the last hex.
template <class T, class Target> inline auto scales_of(const Target &target, std::int64_t first, int count) {
    return scales_of<T>(target, [&](int i) { return first + (i < count ? i : count - 1); });
}

// S W^-1, and a derivative by it as a derivative by S. Without a target it is S itself: the compiler would keep a copy.
template <class T> inline __attribute__((always_inline)) const M3<T> &scale(const M3<T> &s, Unscaled) { return s; }
template <class T> inline __attribute__((always_inline)) M3<T> scale(const M3<T> &s, const ColumnScales<T> &by) {
    return {by.u * s.u, by.v * s.v, by.w * s.w};
}

// det (S W^-1) from det S: the sign stays the same to the last bit.
template <class T> inline __attribute__((always_inline)) T scale(T sigma, Unscaled) { return sigma; }
template <class T> inline __attribute__((always_inline)) T scale(T sigma, const ColumnScales<T> &by) {
    return sigma * (by.u * by.v * by.w);
}

}  // namespace hexmend
