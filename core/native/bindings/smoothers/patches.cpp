#include "smoothers/patches/patch_sweep.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_patches(nb::module_ &m) {
    m.doc() = "Patches that hold several free nodes, and a Newton step of each.";
    m.def("grow", &grow, "hexes"_a, "start"_a, "corners"_a, "free"_a, "size"_a, "overlap"_a, ReleaseGil(),
          "Divide the free nodes (n,) bool into patches of `size` nodes that hang together, breadth first from the\n"
          "lowest that is left; then each also holds those reached in `overlap` steps from node to node of a hex.\n\n"
          "Returns node_start, nodes: the nodes of each patch, ascending; hex_start, chosen: the hexes at them; slots\n"
          "(.., 8): where each corner of these is among the patch's nodes, -1 if it stays.");
    m.def(
        "colours", &colours, "hex_start"_a, "chosen"_a, "hexes"_a, ReleaseGil(),
        "Patches in groups, greedily, so that two of one group share none of so many hexes: (start, patches), int32.");
    m.def(
        "sweep", static_cast<decltype(&sweep)>(&sweep), "points"_a, "hexes"_a, "slots"_a, "hex_start"_a, "node_start"_a,
        "nodes"_a, "groups"_a, "patches"_a, "delta"_a, "power"_a, "first"_a, "shrink"_a, "c1"_a, "cuts"_a, ReleaseGil(),
        "Give the nodes of every patch one Newton step together, in place, the rest being fixed.\n\n"
        "hexes (.., 8) are those of the patches, one patch after another. Group k is patches[groups[k]:groups[k + 1]]\n"
        "and shares no hex: the result is that of one patch after another, whatever the number of threads. delta is\n"
        "meant for the patch scaled to mean edge length 1; power is (p, offset) of the objective; first, shrink, c1 "
        "and\n"
        "cuts are those of the line search, A.5. Returns how often hexes were asked for their energy in line\n"
        "searches, and for its derivatives.");
}

}  // namespace hexmend
