// Rows of arrays that others name by their numbers.
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

// Write `found`: whether one at least of the numbers in each row is marked.
template <std::size_t width>
void any_marked(std::span<const bool> marks, std::span<const std::array<std::int32_t, width>> rows,
                std::span<bool> found);

// Write rows of points: row numbers[k] becomes values[k].
void put_rows(Points values, Indices numbers, std::span<Point> points);

// Multiply rows of vectors: row numbers[k] by factors[k], component by component.
void scale_rows(Points factors, Indices numbers, std::span<Point> vectors);

}  // namespace hexmend
