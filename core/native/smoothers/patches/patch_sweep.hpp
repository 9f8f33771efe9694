// A sweep over patches of several free nodes: one Newton step of each patch, with the other nodes fixed.
#pragma once

#include <utility>

#include "energy/objective_norm.hpp"
#include "mesh/array_views.hpp"
#include "smoothers/line_search.hpp"

namespace hexmend {

// Settings of a step of a patch. Lengths are in mean edge lengths of the patch.
struct PatchStepSettings {
    double delta;
    ObjectiveNorm norm;
    LineSearch search;
};

// Evaluations of a hex's energy in line searches, and of its energy with derivatives.
struct EvaluationCount {
    std::int64_t energies = 0, derivatives = 0;
};

// Patches as `partition` makes them: the hexes and slots (k, 8) of patch p are the rows hex_start[p] to hex_start[p +
// 1] - 1, its nodes are nodes[node_start[p]] to nodes[node_start[p + 1] - 1].
struct PatchPartition {
    Hexes hexes, slots;
    Indices hex_start, node_start, nodes;
};

// Move the nodes of every patch by one Newton step together, in place.
//
// points (n, 3). Group g, patches[groups[g]] to patches[groups[g + 1] - 1], shares no hex, so that the result is that
// of a sequential sweep for any number of threads.
EvaluationCount sweep(std::span<Point> points, const PatchPartition &partition, Indices groups, Indices patches,
                      const PatchStepSettings &settings);

}  // namespace hexmend
