#include "bindings/arrays.hpp"
#include "smoothers/patches/partition.hpp"
#include "smoothers/patches/patch_sweep.hpp"

namespace hexmend {

void bind_patches(nb::module_ &m) {
    m.doc() = "Patches of several free nodes, and a Newton step of each.";
    m.def("grow", &partition_patches, "hexes"_a, "start"_a, "corners"_a, "free"_a, "size"_a, "overlap"_a, ReleaseGil(),
          "Divide the free nodes (n,) bool into connected patches of at most `size` nodes, breadth first from the\n"
          "lowest remaining node; then add to each the nodes within `overlap` steps between nodes of one hex.\n\n"
          "start, corners: `Topology.node_corners`. Returns node_start and nodes: the nodes of each patch, ascending;\n"
          "hex_start and chosen: the hexes at them; slots (.., 8): the number of each corner of these hexes among the\n"
          "patch's nodes, -1 if it is fixed; all int32.");
    m.def("colours", &patch_colours, "hex_start"_a, "chosen"_a, "hexes"_a, ReleaseGil(),
          "Groups of patches that share no hex, by greedy colouring: (start, patches), int32.\n\n"
          "hexes: the number of hexes of the mesh.");
    m.def(
        "sweep",
        [](std::span<Point> points, Hexes hexes, Hexes slots, Indices hex_start, Indices node_start, Indices nodes,
           Indices groups, Indices patches, double delta, ObjectiveNorm power, double first, double shrink, double c1,
           int cuts) {
            PatchStepSettings settings{delta, power, {first, shrink, c1, cuts}};
            auto count = patch_sweep(points, hexes, slots, hex_start, node_start, nodes, groups, patches, settings);
            return std::pair{count.energies, count.derivatives};
        },
        "points"_a, "hexes"_a, "slots"_a, "hex_start"_a, "node_start"_a, "nodes"_a, "groups"_a, "patches"_a, "delta"_a,
        "power"_a, "first"_a, "shrink"_a, "c1"_a, "cuts"_a, ReleaseGil(),
        "Move the nodes of every patch by one Newton step together, in place, with the other nodes fixed.\n\n"
        "hexes and slots (.., 8) are those of the patches, patch after patch. Group k is\n"
        "patches[groups[k]:groups[k + 1]] and shares no hex: the result is that of a sequential sweep for any number\n"
        "of threads. delta applies to the patch scaled to mean edge length 1; power is (p, offset) of the objective;\n"
        "first, shrink, c1 and cuts are the initial step, the backtracking factor, the Armijo constant and the most\n"
        "backtracks of the line search, A.5. Returns the evaluations of a hex's energy in line searches, and of its\n"
        "derivatives.");
}

}  // namespace hexmend
