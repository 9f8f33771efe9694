// Views of the caller's arrays, and arrays that kernels return.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "mesh/hexahedron.hpp"

namespace hexmend {

// View of an (n, width) array: row i is view[i]. Read-only where T is const.
template <class T, std::size_t width>
using ArrayView = std::span<
    std::conditional_t<std::is_const_v<T>, const std::array<std::remove_const_t<T>, width>, std::array<T, width>>>;

using Points = std::span<const Point>;
using Hexes = std::span<const Hex>;
using Indices = std::span<const std::int32_t>;
using Numbers = std::span<const double>;

// The hex behind each face, -1 for none.
using Neighbours = ArrayView<const Node, 6>;

// Vectors at the eight corners of each hex, (m, 8, 3).
using CornerVectors = std::span<std::array<double, 24>>;

// Throw std::invalid_argument if the caller's arrays do not fit each other.
inline void expect(bool fits, const char *message) {
    if (!fits) throw std::invalid_argument(message);
}

// True if each of the arrays has so many rows.
template <class... Array> bool have_rows(std::size_t rows, const Array &...arrays) {
    return ((arrays.size() == rows) && ...);
}

// True if compressed rows end with the last of so many items; see csr.hpp.
template <class Number> bool are_csr(std::span<const Number> start, std::size_t items) {
    return !start.empty() && std::cmp_equal(start.back(), items);
}

// Throw unless start and corners can be the corners of so many cells at each node, see incidence.hpp.
inline void expect_corners(std::size_t cells, Indices start, Indices corners) {
    expect(4 * cells <= corners.size() && corners.size() <= 8 * cells, "corners: four to eight a cell are expected");
    expect(are_csr(start, corners.size()), "start: its last number is expected to be the length of corners");
}

// Throw unless they can be the edge neighbours of each of so many nodes.
inline void expect_rings(std::size_t nodes, Indices ring_start, Indices ring) {
    expect(ring_start.size() == nodes + 1, "ring_start: one more than the nodes is expected");
    expect(are_csr(ring_start, ring.size()), "ring_start: its last number is expected to be the length of ring");
}

// One byte per hex: bit t is set if corner tetrahedron t is omitted, that is, counts as perfect.
using OmittedCorners = std::span<const std::uint8_t>;

// Array (n,) or (n, width) that a kernel returns to Python. Booleans are stored as bytes: std::vector<bool> has no
// data().
template <class T, std::size_t width = 1> struct OwnedArray {
    std::vector<std::conditional_t<std::is_same_v<T, bool>, std::uint8_t, T>> values;
};

using IntArray = OwnedArray<std::int32_t>;
using CSR = std::pair<IntArray, IntArray>;  // row starts, items

}  // namespace hexmend
