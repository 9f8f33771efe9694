// Local optimisation: one line-searched step at each free node, colour by colour (Algorithm 3.2).
#pragma once

#include "energy/objective_norm.hpp"
#include "energy/target.hpp"
#include "mesh/hex_mesh.hpp"
#include "smoothers/line_search.hpp"

namespace hexmend {

// Search directions: Algorithms A.2, A.3 and A.4.
enum Direction { STEEPEST_DESCENT, NEWTON, MODIFIED_NEWTON };

// Result of a step at a node: the node moved; no step descended; the gradient is 0 or the patch has no extent; the
// energy is infinite.
enum StepStatus { MOVED, NO_DESCENT, FLAT, INFINITE };

// Settings of a step at a node. Lengths are in mean edge lengths of the node's patch, those of delta with a target in
// lengths of each hex's target.
struct NodeStepSettings {
    Direction direction;
    double delta;
    ObjectiveNorm norm;
    LineSearch search;
    const TargetMatrices *target = nullptr;
};

// Move each of `nodes` once, in place: one pass of Algorithm 3.2. Group k, nodes[groups[k]] to nodes[groups[k + 1] -
// 1], shares no hex. Returns the evaluations of a hex's energy in line searches.
std::int64_t local_sweep(std::span<Point> points, const HexMesh &mesh, Indices groups, Indices nodes,
                         const NodeStepSettings &settings);

// Energy of a node's patch, and its derivatives by the node in the scaled patch.
struct PatchEnergy {
    double factor;  // by which lengths are multiplied; 0 where the patch has no extent
    double value;
    std::array<double, 3> gradient;
    std::array<double, 6> hessian;  // xx xy xz yy yz zz
};

// Energy of the patch of the node whose corners are `star`; factor = 0 scales it to mean edge length 1.
PatchEnergy patch_energy(Points points, Hexes hexes, Indices star, double factor, double delta, ObjectiveNorm norm,
                         const TargetMatrices *target = nullptr);

// A step at one node, in mean edge lengths of its patch.
struct RecordedStep {
    StepStatus status;
    std::array<double, 3> direction;  // and its slope: 0 where the status is FLAT or INFINITE
    double slope;
    bool fallback;  // steepest descent, because Newton's direction did not descend
    double shift;   // added to the eigenvalues of the Hessian by Algorithm A.4
    double alpha;   // accepted step length, and the point that it leads to: 0 unless the status is MOVED
    Point place;
    OwnedArray<double, 3> trials;  // (trials, 3): alpha, value and bound of each
};

// The step that `local_sweep` takes at one node; moves nothing.
RecordedStep recorded_step(Points points, Hexes hexes, Indices star, const NodeStepSettings &settings);

// Energy of a patch along a direction: writes the value at step length curve[k][0] to curve[k][1].
void energy_along(Points points, Hexes hexes, Indices star, double factor, std::array<double, 3> direction,
                  double delta, ObjectiveNorm norm, std::span<std::array<double, 2>> curve,
                  const TargetMatrices *target = nullptr);

}  // namespace hexmend
