#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>

#include "bindings/arrays.hpp"
#include "mesh/incidence.hpp"
#include "smoothers/getme.hpp"
#include "smoothers/laplacian.hpp"
#include "smoothers/line_search.hpp"
#include "smoothers/local.hpp"
#include "smoothers/patches/patches.hpp"
#include "smoothers/sliding.hpp"
#include "smoothers/step_limits.hpp"
#include "smoothers/worst_first.hpp"

namespace hexmend {

void bind_element_step(nb::module_ m) {
    m.doc() = "GETMe's element step, which makes one hex more regular.";
    m.def("element_steps", &element_steps, "points"_a, "hexes"_a, "s"_a, "rho"_a, "places"_a, ReleaseGil(),
          "Targets of the corners of every hex; writes places (m, 8, 3).\n\n"
          "Corner k moves to c_k + s n_k/sqrt(|n_k|), centroid and normal of the triangle of the centroids of its\n"
          "three faces; the hex is scaled to its old mean edge length and blended with the old one by rho.\n"
          "Vartziotis and Wipper 2011, CMAME 200:1186; thesis 3.1.2.");
}

void bind_getme(nb::module_ m) {
    m.doc() =
        "Simultaneous GETMe: a node moves to the weighted mean of the targets that its hexes' element steps give it.";
    m.def("weighted_means", &weighted_means, "places"_a, "weights"_a, "mesh"_a, "nodes"_a, "targets"_a, ReleaseGil(),
          "Means of the targets, places (m, 8, 3), of each of `nodes` over its hexes, by their weights (m,);\n"
          "writes targets (n, 3).");
    m.def("relax", &relax, "points"_a, "mesh"_a, "valid"_a, "harmed"_a, "moved"_a, ReleaseGil(),
          "Shorten moves until no hex that was valid is inverted; returns the number of shortened moves.\n\n"
          "points (n, 3): before the move. valid (m,) bool: hexes that were valid there. harmed (k,) int32: those\n"
          "that are inverted at `moved` (n, 3), which is changed. In each round the nodes of all inverted hexes\n"
          "halve their moves, the fourth time to nothing; a hex none of whose nodes moves is as it was, so the\n"
          "rounds end.");
}

void bind_laplacian(nb::module_ m) {
    m.doc() =
        "Laplacian sweeps: a node moves to the mean of its edge neighbours. ring_start, ring: `Topology.rings`.\n\n"
        "With a surface the means of nodes that slide are projected onto it.";
    m.def("in_place", &in_place, "points"_a, "ring_start"_a, "ring"_a, "nodes"_a, "surface"_a.none() = nb::none(),
          ReleaseGil(), "Algorithm 3.1: one node after another; changes points (n, 3).");
    m.def("simultaneous", &simultaneous, "points"_a, "ring_start"_a, "ring"_a, "nodes"_a, "moved"_a, ReleaseGil(),
          "All nodes at once, from the old positions of the others; writes moved (n, 3).");
    m.def("smart_sweep", &smart_sweep, "points"_a, "mesh"_a, "ring_start"_a, "ring"_a, "nodes"_a,
          "keep_least_quality"_a, "surface"_a.none() = nb::none(), ReleaseGil(),
          "Smart Laplacian: Algorithm 3.1 without moves that do harm; changes points (n, 3), returns the number of\n"
          "rejected moves.\n\n"
          "A move does harm if it inverts a valid hex or, with keep_least_quality, lowers the least q(H) of the\n"
          "hexes at the node.");
}

void bind_line_search(nb::module_ m) {
    m.doc() = "Step length: Algorithm A.5.";
    nb::class_<LineSearch>(m, "LineSearch", "Backtracking line search with the Armijo condition, Algorithm A.5.")
        .def(nb::init<double, double, double, int>(), "initial_step"_a = 1.0, "backtrack_factor"_a = 0.7, "c1"_a = 1e-4,
             "max_backtracks"_a = 100,
             "initial_step is the first step length alpha, backtrack_factor the factor lambda by which a rejected\n"
             "step is shortened, c1 the share of the slope that a step must descend.")
        .def_ro("initial_step", &LineSearch::initial_step)
        .def_ro("backtrack_factor", &LineSearch::backtrack_factor)
        .def_ro("c1", &LineSearch::c1)
        .def_ro("max_backtracks", &LineSearch::max_backtracks)
        .def(
            "with_initial_step",
            [](const LineSearch &search, double initial_step) {
                LineSearch other = search;
                other.initial_step = initial_step;
                return other;
            },
            "initial_step"_a, "Search that begins with another step length.\n")
        .def(
            "__call__",
            [](const LineSearch &search, const nb::callable &energy_along, double value, double slope) {
                int trials = 0;
                double alpha = search(value, slope, [&](double alpha, double) {
                    ++trials;
                    return nb::cast<double>(energy_along(alpha));
                });
                return std::pair{alpha, trials - 1};
            },
            "energy_along"_a, "value"_a, "slope"_a,
            "Find a step that descends: (alpha, number of backtracks); alpha is 0 if none descends.\n\n"
            "energy_along maps alpha to f(x + alpha p), +inf beyond the barrier; value is f(x), slope the\n"
            "derivative along p, below 0. The search also ends where the expected descent is lost in the rounding\n"
            "of value.");
}

void bind_local(nb::module_ m) {
    m.doc() = "Local optimisation: one line-searched step at each free node, Algorithm 3.2.";
    nb::enum_<Direction>(m, "Direction", "Search direction.")
        .value("STEEPEST_DESCENT", STEEPEST_DESCENT, "Algorithm A.2.")
        .value("NEWTON", NEWTON, "Algorithm A.3.")
        .value("MODIFIED_NEWTON", MODIFIED_NEWTON, "Algorithm A.4.");
    nb::enum_<StepStatus>(m, "StepStatus", "Result of a step at a node.")
        .value("MOVED", MOVED, "The node moved.")
        .value("NO_DESCENT", NO_DESCENT, "No step descended.")
        .value("FLAT", FLAT, "The gradient is 0, or the patch has no extent.")
        .value("INFINITE", INFINITE, "The energy is infinite.");
    nb::class_<NodeStepSettings>(m, "NodeStepSettings", "Settings of a step at a node.")
        .def(nb::init<Direction, double, ObjectiveNorm, LineSearch, const TargetMatrices *>(), "direction"_a, "delta"_a,
             "norm"_a, "search"_a, "target"_a.none() = nb::none(), nb::keep_alive<1, 6>(),
             "delta applies to the patch scaled to mean edge length 1, with a target to S W^-1; norm is (p, offset)\n"
             "of the objective.");
    m.def(
        "sweep",
        [](std::span<Point> points, const HexMesh &mesh, Indices groups, Indices nodes,
           const NodeStepSettings &settings, const SlidingSurface *surface,
           std::optional<std::span<const Tangents>> tangents, const SurfaceTerm *term) {
            expect(!surface == !tangents, "surface and tangents: both or none are expected");
            expect(surface || !term, "term: it counts on a surface alone");
            return surface ? sliding_sweep(points, mesh, groups, nodes, settings, *surface, *tangents, term)
                           : local_sweep(points, mesh, groups, nodes, settings);
        },
        "points"_a, "mesh"_a, "groups"_a, "nodes"_a, "settings"_a, "surface"_a.none() = nb::none(),
        "tangents"_a = nb::none(), "term"_a.none() = nb::none(), ReleaseGil(),
        "Move each of `nodes` once, in place: one pass of Algorithm 3.2.\n\n"
        "points (n, 3) float64, changed. Group k is nodes[groups[k]:groups[k + 1]]; nodes of one group share no\n"
        "hex, so that the result is that of a sequential sweep for any number of threads. With a surface, nodes\n"
        "that slide step along it: T'g and T'HT are the derivatives, tangents (k, 6) float64 the two unit tangents\n"
        "T of each, the second 0 on a curve, and the line search evaluates the energy at projected points. With a\n"
        "term the quads of the surface count in their objective.\n\n"
        "Returns the number of evaluations of a hex's energy in line searches.");
    nb::class_<PatchEnergy>(m, "PatchEnergy", "Energy of a node's patch, its gradient and Hessian by the node.")
        .def_ro("factor", &PatchEnergy::factor, "Factor by which lengths are multiplied; 0 for a patch without extent.")
        .def_ro("value", &PatchEnergy::value)
        .def_ro("gradient", &PatchEnergy::gradient)
        .def_ro("hessian", &PatchEnergy::hessian, "xx, xy, xz, yy, yz, zz");
    m.def("patch_energy", &patch_energy, "points"_a, "hexes"_a, "star"_a, "factor"_a, "delta"_a, "norm"_a,
          "target"_a.none() = nb::none(), ReleaseGil(),
          "Energy of the patch of the node whose corners are star (k,) int32, 8 * hex + corner each.\n\n"
          "Lengths are multiplied by `factor`, or scaled to mean edge length 1 where it is 0, with a target to unit\n"
          "root mean square of the inverse lengths.");
    nb::class_<RecordedStep>(m, "RecordedStep", "A step at one node, in mean edge lengths of its patch.")
        .def_ro("status", &RecordedStep::status)
        .def_ro("direction", &RecordedStep::direction, "0 where the status is FLAT or INFINITE")
        .def_ro("slope", &RecordedStep::slope, "Derivative of the energy along the direction.")
        .def_ro("fallback", &RecordedStep::fallback, "True if Newton's direction did not descend: steepest descent.")
        .def_ro("shift", &RecordedStep::shift, "Shift of the eigenvalues by Algorithm A.4.")
        .def_ro("alpha", &RecordedStep::alpha, "Accepted step length; 0 for none.")
        .def_ro("place", &RecordedStep::place, "The point that the step leads to, if the node MOVED.")
        .def_prop_ro(
            "trials", [](const RecordedStep &step) { return OwnedArray<double, 3>{step.trials}; },
            "alpha, energy and bound of each trial, (trials, 3); a copy.");
    m.def("recorded_step", &recorded_step, "points"_a, "hexes"_a, "star"_a, "settings"_a, ReleaseGil(),
          "The step that `sweep` takes at the node whose corners are star (k,) int32; moves nothing.\n");
    m.def("energy_along", &energy_along, "points"_a, "hexes"_a, "star"_a, "factor"_a, "direction"_a, "delta"_a,
          "norm"_a, "curve"_a, "target"_a.none() = nb::none(), ReleaseGil(),
          "Energy of a patch along a direction (3,): writes the value at step length curve[:, 0] to curve[:, 1].\n\n"
          "star and factor: those of `patch_energy`.");
}

void bind_patches(nb::module_ m) {
    m.doc() = "Patches of several free nodes, and a Newton step of each.";
    nb::class_<PatchPartition>(m, "PatchPartition", "Patches, as `partition` makes them.")
        .def(ViewOf<Hexes, Hexes, Indices, Indices, Indices>(), "hexes"_a, "slots"_a, "hex_start"_a, "node_start"_a,
             "nodes"_a, "hexes and slots (.., 8) are those of the patches, patch after patch, as hex_start says.");
    m.def("partition", &partition, "mesh"_a, "free"_a, "size"_a, "overlap"_a, ReleaseGil(),
          "Divide the free nodes (n,) bool into connected patches of at most `size` nodes, breadth first from the\n"
          "lowest remaining node; then add to each the nodes within `overlap` steps between nodes of one hex.\n\n"
          "Returns node_start and nodes: the nodes of each patch, ascending; hex_start and patch_hexes: the hexes\n"
          "at them; slots (.., 8): the number of each corner of these hexes among the patch's nodes, -1 if it is\n"
          "fixed; all int32.");
    m.def("colours", &colours, "hex_start"_a, "patch_hexes"_a, "hexes"_a, ReleaseGil(),
          "Groups of patches that share no hex, by greedy colouring: (start, patches), int32.\n\n"
          "hexes: the number of hexes of the mesh.");
    m.def("sweep", &patch_sweep, "points"_a, "partition"_a, "groups"_a, "patches"_a, "settings"_a, ReleaseGil(),
          "Move the nodes of every patch by one Newton step together, in place, with the other nodes fixed.\n\n"
          "Group k is patches[groups[k]:groups[k + 1]] and shares no hex: the result is that of a sequential sweep\n"
          "for any number of threads. The target has a row for each of the partition's hexes. Returns the evaluations\n"
          "of a hex's energy in line searches, and of its derivatives.");
}

void bind_step_limits(nb::module_ m) {
    m.doc() = "Steps of nodes: their limits, and the points that they lead to.";
    m.def("shorten", &shorten, "step"_a, "points"_a, "mesh"_a, "nodes"_a, "reach"_a, ReleaseGil(),
          "Shorten the steps (k, 3) of `nodes` (k,) that are longer than `reach` times the mean length of the\n"
          "node's edges; changes step.");
    m.def("displaced", &displaced, "points"_a, "nodes"_a, "step"_a, "alpha"_a, "moved"_a, ReleaseGil(),
          "Points (n, 3) with `nodes` (k,) displaced by alpha times their steps (k, 3); writes moved (n, 3).");
}

void bind_wavefronts(nb::module_ m) {
    m.doc() = "Order of the nodes in a sweep, and groups of nodes that can be stepped at the same time.";
    m.def("levels", &levels, "ring_start"_a, "ring"_a, "start"_a, ReleaseGil(),
          "Number of edges between each node and the nearest where `start` (n,) bool is true; (n,) int32.\n\n"
          "One more than the deepest level where there is no way.");
    m.def("wavefronts", &wavefronts, "start"_a, "corners"_a, "sequence"_a, ReleaseGil(),
          "Groups of the nodes of a sequence: (group_start, nodes), both int32.\n\n"
          "No hex has two nodes of one group, and a node's group follows those of all earlier nodes of its hexes.\n"
          "Sweeping group after group, the nodes of each in parallel, equals sweeping the sequence.");
}

void bind_worst_first(nb::module_ m) {
    m.doc() = "Sequential GETMe: the worst hex takes its element step, again and again, from a priority queue.";
    nb::class_<WorstFirstSettings>(m, "WorstFirstSettings", "Settings of the element steps.")
        .def(nb::init<double, double, double, double>(), "scaling"_a, "relaxation"_a, "penalty"_a,
             "rejection_penalty"_a,
             "scaling and relaxation are the scale s and the blend rho of an element step. After it the hex ranks\n"
             "as better by penalty if the step was accepted and by rejection_penalty if not, in q(H).");
    m.def("sweep", &worst_first_sweep, "points"_a, "mesh"_a, "free"_a, "candidates"_a, "q"_a, "valid"_a, "settings"_a,
          "surface"_a.none() = nb::none(), ReleaseGil(),
          "Take as many element steps as there are candidates, each of the hex that is worst at the time; returns\n"
          "the number of rejected steps, those that inverted a valid hex.\n\n"
          "points (n, 3), changed, end at the best state reached: fewest inverted hexes, then highest q_min, then\n"
          "highest q_mean. free (n,) bool; candidates (k,) int32: the hexes that have a free node. q (m,) float64\n"
          "and valid (m,) bool, as measured at points, are changed to those of the last state, which need not be\n"
          "the best. With a surface each element step is projected before it is checked.");
}

}  // namespace hexmend
