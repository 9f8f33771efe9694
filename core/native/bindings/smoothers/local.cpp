#include "smoothers/local.hpp"

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>

#include "bindings/arrays.hpp"
#include "smoothers/sliding.hpp"

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
    nb::class_<NodeStepSettings>(m, "NodeStepSettings", "Settings of a step at a node.")
        .def(
            nb::init<int, double, ObjectiveNorm, LineSearch>(), "direction"_a, "delta"_a, "norm"_a, "search"_a,
            "direction is STEEPEST_DESCENT, NEWTON or MODIFIED_NEWTON; delta applies to the patch scaled to mean edge\n"
            "length 1; norm is (p, offset) of the objective.");
    m.def(
        "sweep",
        [](std::span<Point> points, const HexMesh &mesh, Indices groups, Indices nodes,
           const NodeStepSettings &settings, const SlidingSurface *surface,
           std::optional<std::span<const Tangents>> tangents) {
            expect(!surface == !tangents, "surface and tangents: both or none are expected");
            return surface ? sliding_sweep(points, mesh, groups, nodes, settings, *surface, *tangents)
                           : sweep(points, mesh, groups, nodes, settings);
        },
        "points"_a, "mesh"_a, "groups"_a, "nodes"_a, "settings"_a, "surface"_a.none() = nb::none(),
        "tangents"_a = nb::none(), ReleaseGil(),
        "Move each of `nodes` once, in place: one pass of Algorithm 3.2.\n\n"
        "points (n, 3) float64, changed. Group k is nodes[groups[k]:groups[k + 1]]; nodes of one group share no hex,\n"
        "so that the result is that of a sequential sweep for any number of threads. With a surface, nodes that slide\n"
        "step along it: T'g and T'HT are the derivatives, tangents (k, 6) float64 the two unit tangents T of each, "
        "the\n"
        "second 0 on a curve, and the line search evaluates the energy at projected points.\n\n"
        "Returns the number of evaluations of a hex's energy in line searches.");
    m.def(
        "patch_energy", &patch_energy, "points"_a, "hexes"_a, "star"_a, "factor"_a, "delta"_a, "norm"_a, ReleaseGil(),
        "Energy of the patch of the node whose corners are star (k,) int32, 8 * hex + corner each.\n\n"
        "Lengths are multiplied by `factor`, or scaled to mean edge length 1 where it is 0. Returns the factor, 0 if\n"
        "the patch has no extent; the value; its gradient (3,); its second derivatives xx xy xz yy yz zz.");
    m.def(
        "recorded_step", &recorded_step, "points"_a, "hexes"_a, "star"_a, "settings"_a, ReleaseGil(),
        "The step that `sweep` takes at the node whose corners are star (k,) int32; moves nothing.\n\n"
        "Returns the status (MOVED, NO_DESCENT, FLAT or INFINITE); the direction, its slope, whether it fell back to\n"
        "steepest descent, the shift of A.4; the accepted step length, 0 for none, and the point that it leads to;\n"
        "and alpha, energy and bound of each trial, (trials, 3). FLAT and INFINITE have no direction, and only MOVED\n"
        "has a point. The direction is in mean edge lengths of the patch.");
    m.def("energy_along", &energy_along, "points"_a, "hexes"_a, "star"_a, "factor"_a, "direction"_a, "delta"_a,
          "norm"_a, "curve"_a, ReleaseGil(),
          "Energy of a patch along a direction (3,): writes the value at step length curve[:, 0] to curve[:, 1].\n\n"
          "star and factor: those of `patch_energy`.");
}

}  // namespace hexmend
