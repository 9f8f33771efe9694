// Averages along dual sheets: each hex has three groups of four parallel edges, and edges of one group are neighbours.
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

// Edges of a group; the number of edges stands for none.
using EdgeGroups = ArrayView<const std::int32_t, 4>;

// Average of the values of edges over the groups around each edge: the mean of the groups' means; 0 and a count of 0
// where there is none. The last value stands for no edge.
void average_along_sheets(EdgeGroups groups, Numbers values, std::span<double> average, std::span<std::int32_t> count);

}  // namespace hexmend
