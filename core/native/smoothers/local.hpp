// Local optimisation: one line-searched step at each free node, colour by colour (Algorithm 3.2).
#pragma once

#include <tuple>

#include "energy/objective_norm.hpp"
#include "mesh/hex_mesh.hpp"
#include "smoothers/line_search.hpp"

namespace hexmend {

// Search directions: Algorithms A.2, A.3 and A.4.
enum Direction { STEEPEST_DESCENT, NEWTON, MODIFIED_NEWTON };

// Result of a step at a node: the node moved; no step descended; the gradient is 0 or the patch has no extent; the
// energy is infinite.
enum StepStatus { MOVED, NO_DESCENT, FLAT, INFINITE };

// Settings of a step at a node. Lengths are in mean edge lengths of the node's patch.
struct NodeStepSettings {
    int direction;  // a Direction
    double delta;
    ObjectiveNorm norm;
    LineSearch search;
};

// Move each of `nodes` once, in place: one pass of Algorithm 3.2.
//
// points (n, 3). Group k of nodes, nodes[groups[k]] to nodes[groups[k + 1] - 1], shares no hex, so that the result is
// that of a sequential sweep for any number of threads. Returns the evaluations of a hex's energy in line searches.
std::int64_t sweep(std::span<Point> points, const HexMesh &mesh, Indices groups, Indices nodes,
                   const NodeStepSettings &settings);

// Energy of the patch of the node whose corners are `star`: the factor by which lengths are multiplied (0 where the
// patch has no extent), the value, its gradient (3,) and its second derivatives xx xy xz yy yz zz. factor = 0 scales
// the patch to mean edge length 1.
std::tuple<double, double, std::array<double, 3>, std::array<double, 6>> patch_energy(Points points, Hexes hexes,
                                                                                      Indices star, double factor,
                                                                                      double delta, ObjectiveNorm norm);

// The step that `sweep` takes at one node, with all trials; moves nothing. Returns the status; the direction, its
// slope, whether it is the fallback, the shift of A.4; the step length, the point that it leads to, and (alpha, value,
// bound) of each trial, (trials, 3).
std::tuple<int, std::array<double, 3>, double, bool, double, double, std::array<double, 3>, OwnedArray<double, 3>>
recorded_step(Points points, Hexes hexes, Indices star, const NodeStepSettings &settings);

// Energy of a patch along a direction: writes the value at step length curve[k][0] to curve[k][1].
void energy_along(Points points, Hexes hexes, Indices star, double factor, std::array<double, 3> direction,
                  double delta, ObjectiveNorm norm, std::span<std::array<double, 2>> curve);

}  // namespace hexmend
