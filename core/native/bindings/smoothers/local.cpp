#include "smoothers/local.hpp"

#include <nanobind/stl/array.h>

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_local(nb::module_ &m) {
    m.doc() = "One line-searched step per free node: Algorithm 3.2.";
    m.attr("STEEPEST_DESCENT") = static_cast<int>(STEEPEST_DESCENT);
    m.attr("NEWTON") = static_cast<int>(NEWTON);
    m.attr("MODIFIED_NEWTON") = static_cast<int>(MODIFIED_NEWTON);
    m.attr("MOVED") = static_cast<int>(MOVED);
    m.attr("NO_DESCENT") = static_cast<int>(NO_DESCENT);
    m.attr("FLAT") = static_cast<int>(FLAT);
    m.attr("INFINITE") = static_cast<int>(INFINITE);
    m.def("sweep", &sweep, "points"_a, "hexes"_a, "start"_a, "corners"_a, "groups"_a, "nodes"_a, "direction"_a,
          "delta"_a, "power"_a, "first"_a, "shrink"_a, "c1"_a, "cuts"_a, ReleaseGil(),
          "Move every node of `nodes` once, in place: one pass of Algorithm 3.2.\n\n"
          "Group k is nodes[groups[k]:groups[k + 1]]. Nodes of one group share no hex, so that each sees the others\n"
          "where they stay: the result is that of a sequential sweep, whatever the number of threads. delta is meant\n"
          "for the patch scaled to mean edge length 1; power is (p, offset) of the objective; first, shrink, c1 and "
          "cuts\n"
          "are those of the line search, A.5. Returns how often its trial steps asked a hex for its energy.");
    m.def("look", &look, "points"_a, "hexes"_a, "star"_a, "factor"_a, "delta"_a, "power"_a, ReleaseGil(),
          "What a visit of `sweep` begins with, at the node that the corners `star` (8 * hex + corner) share.\n\n"
          "Lengths are multiplied by `factor`; if that is 0, so that the patch's mean edge is 1. Returns the factor,\n"
          "0 if the patch has no extent; the value; its gradient; second derivatives xx xy xz yy yz zz.");
    m.def("visit", &visit, "points"_a, "hexes"_a, "star"_a, "direction"_a, "delta"_a, "power"_a, "first"_a, "shrink"_a,
          "c1"_a, "cuts"_a, ReleaseGil(),
          "What `sweep` does at one node, that the corners `star` (8 * hex + corner) share; it moves nothing.\n\n"
          "Returns the verdict (MOVED, NO_DESCENT, FLAT, INFINITE); the direction, its slope, whether it fell back to\n"
          "steepest descent, what A.4 added to the eigenvalues; the accepted step and the place that it leads to; and\n"
          "alpha, energy and bound of each trial, (trials, 3). Where the verdict is FLAT or INFINITE, there is no\n"
          "direction; a place only where it is MOVED. The direction is in lengths so that the patch's mean edge is 1.");
    m.def("along", &along, "points"_a, "hexes"_a, "star"_a, "factor"_a, "direction"_a, "delta"_a, "power"_a, "curve"_a,
          ReleaseGil(), "Write the patch's energy at curve[:, 0] times a direction to curve[:, 1].");
}

}  // namespace hexmend
