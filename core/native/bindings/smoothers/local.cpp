#include "smoothers/local.hpp"

#include <nanobind/stl/array.h>

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_local(nb::module_ &m) {
    m.doc() = "Local optimisation: one line-searched step at each free node, Algorithm 3.2.";
    m.attr("STEEPEST_DESCENT") = static_cast<int>(STEEPEST_DESCENT);
    m.attr("NEWTON") = static_cast<int>(NEWTON);
    m.attr("MODIFIED_NEWTON") = static_cast<int>(MODIFIED_NEWTON);
    m.attr("MOVED") = static_cast<int>(MOVED);
    m.attr("NO_DESCENT") = static_cast<int>(NO_DESCENT);
    m.attr("FLAT") = static_cast<int>(FLAT);
    m.attr("INFINITE") = static_cast<int>(INFINITE);
    m.def(
        "sweep",
        [](std::span<Point> points, Hexes hexes, Indices start, Indices corners, Indices groups, Indices nodes,
           int direction, double delta, ObjectiveNorm power, double first, double shrink, double c1, int cuts) {
            NodeStepSettings settings{direction, delta, power, {first, shrink, c1, cuts}};
            return sweep(points, hexes, start, corners, groups, nodes, settings);
        },
        "points"_a, "hexes"_a, "start"_a, "corners"_a, "groups"_a, "nodes"_a, "direction"_a, "delta"_a, "power"_a,
        "first"_a, "shrink"_a, "c1"_a, "cuts"_a, ReleaseGil(),
        "Move each of `nodes` once, in place: one pass of Algorithm 3.2.\n\n"
        "points (n, 3) float64, changed; hexes (m, 8) int32; start, corners: `Topology.node_corners`. Group k is\n"
        "nodes[groups[k]:groups[k + 1]]; nodes of one group share no hex, so that the result is that of a sequential\n"
        "sweep for any number of threads. direction is one of the constants; delta applies to the patch scaled to\n"
        "mean edge length 1; power is (p, offset) of the objective; first, shrink, c1 and cuts are the initial step,\n"
        "the backtracking factor, the Armijo constant and the most backtracks of the line search, A.5.\n\n"
        "Returns the number of evaluations of a hex's energy in line searches.");
    m.def(
        "look", &patch_energy, "points"_a, "hexes"_a, "star"_a, "factor"_a, "delta"_a, "power"_a, ReleaseGil(),
        "Energy of the patch of the node whose corners are star (k,) int32, 8 * hex + corner each.\n\n"
        "Lengths are multiplied by `factor`, or scaled to mean edge length 1 where it is 0. Returns the factor, 0 if\n"
        "the patch has no extent; the value; its gradient (3,); its second derivatives xx xy xz yy yz zz.");
    m.def(
        "visit",
        [](Points points, Hexes hexes, Indices star, int direction, double delta, ObjectiveNorm power, double first,
           double shrink, double c1, int cuts) {
            return recorded_step(points, hexes, star, {direction, delta, power, {first, shrink, c1, cuts}});
        },
        "points"_a, "hexes"_a, "star"_a, "direction"_a, "delta"_a, "power"_a, "first"_a, "shrink"_a, "c1"_a, "cuts"_a,
        ReleaseGil(),
        "The step that `sweep` takes at the node whose corners are star (k,) int32; moves nothing.\n\n"
        "Returns the status (MOVED, NO_DESCENT, FLAT or INFINITE); the direction, its slope, whether it fell back to\n"
        "steepest descent, the shift of A.4; the accepted step length, 0 for none, and the point that it leads to;\n"
        "and alpha, energy and bound of each trial, (trials, 3). FLAT and INFINITE have no direction, and only MOVED\n"
        "has a point. The direction is in mean edge lengths of the patch.");
    m.def("along", &energy_along, "points"_a, "hexes"_a, "star"_a, "factor"_a, "direction"_a, "delta"_a, "power"_a,
          "curve"_a, ReleaseGil(),
          "Energy of a patch along a direction (3,): writes the value at step length curve[:, 0] to curve[:, 1].\n\n"
          "star and factor: as for `look`.");
}

}  // namespace hexmend
