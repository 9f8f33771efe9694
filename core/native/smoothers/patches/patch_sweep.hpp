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

// Move the nodes of every patch by one Newton step together, in place.
//
// points (n, 3); hexes and slots (k, 8) are those of `partition_patches`, patch after patch, as hex_start says; the
// nodes of patch p are nodes[node_start[p]] to nodes[node_start[p + 1] - 1]. Group g, patches[groups[g]] to
// patches[groups[g + 1] - 1], shares no hex, so that the result is that of a sequential sweep for any number of
// threads.
EvaluationCount patch_sweep(std::span<Point> points, Hexes hexes, Hexes slots, Indices hex_start, Indices node_start,
                            Indices nodes, Indices groups, Indices patches, const PatchStepSettings &settings);

}  // namespace hexmend
