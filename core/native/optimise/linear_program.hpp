// Rows of the linear program of a step: displacements of nodes along given directions, by linear models of values.
#pragma once

#include <tuple>

#include "mesh/array_views.hpp"

namespace hexmend {

// Models (r,) of values that depend on four nodes each.
struct LinearModels {
    std::span<const std::array<Node, 4>> nodes;
    std::span<const std::array<double, 12>> slopes;  // by the places of the four nodes
    Numbers gains;                                   // coefficients in the last column
};

// Directions of nodes: those of node k are rows first[k] to first[k + 1] - 1.
struct NodeDirections {
    std::span<const std::int64_t> first;
    Points displacements;
    std::span<const std::int64_t> columns;  // of the unknowns that they belong to
};

using LongArray = OwnedArray<std::int64_t>;

// The rows of minus the slopes of each model along the directions of its nodes, by `index`, the number of each node
// among those with directions, -1 for none; and of the gain in the last column, `gain_column`. Returns where each row
// begins, the columns and the values. A node that a model has twice counts with the sum of its slopes.
std::tuple<LongArray, LongArray, OwnedArray<double>> program_rows(const LinearModels &models, Indices index,
                                                                  const NodeDirections &directions,
                                                                  std::int64_t gain_column);

}  // namespace hexmend
