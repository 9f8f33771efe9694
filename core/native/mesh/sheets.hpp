// Averages along dual sheets: each hex has three groups of four parallel edges, and edges of one group are neighbours.
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

// Edges of a group; the number of edges stands for none.
using EdgeGroups = ArrayView<const std::int32_t, 4>;

// Average of the values of edges over the groups around each edge: the mean of the groups' means; 0 and a count of 0
// where there is none. The last value stands for no edge.
void average_along_sheets(EdgeGroups groups, Numbers values, std::span<double> average, std::span<std::int32_t> count);

// Fill in the values of unknown edges from the known ones of their groups, front by front; each front is the average
// over the groups with an edge that was known before it. Edges that no front reaches stay unknown.
void fill_along_sheets(EdgeGroups groups, std::span<double> values, std::span<bool> known);

}  // namespace hexmend
