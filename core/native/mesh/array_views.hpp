// Arrays as kernels see them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "mesh/hexahedron.hpp"

namespace hexmend {

// Row i of an (n, width) array is rows[i]. Read where T is const.
template <class T, std::size_t width>
using ArrayView = std::span<
    std::conditional_t<std::is_const_v<T>, const std::array<std::remove_const_t<T>, width>, std::array<T, width>>>;

using Points = std::span<const Point>;
using Hexes = std::span<const Hex>;
using Indices = std::span<const std::int32_t>;
using Numbers = std::span<const double>;

// For what people outside hand over: as many rows of one array as of another.
inline void expect(bool fits, const char *what) {
    if (!fits) throw std::invalid_argument(what);
}

// A byte a hex: bit t is set where its corner tetrahedron t is left out, as if it were perfect.
using OmittedCorners = std::span<const std::uint8_t>;

// What a kernel makes and hands over: an array (n,), or (n, width). Truths are bytes: std::vector<bool> is no array.
template <class T, std::size_t width = 1> struct OwnedArray {
    std::vector<std::conditional_t<std::is_same_v<T, bool>, std::uint8_t, T>> values;
};

}  // namespace hexmend
