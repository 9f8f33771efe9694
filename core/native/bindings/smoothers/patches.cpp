#include "bindings/arrays.hpp"
#include "smoothers/patches/partition.hpp"
#include "smoothers/patches/patch_sweep.hpp"

namespace hexmend {

void bind_patches(nb::module_ &m) {
    m.doc() = "Patches of several free nodes, and a Newton step of each.";
    nb::class_<PatchStepSettings>(m, "PatchStepSettings", "Settings of a step of a patch.")
        .def(nb::init<double, ObjectiveNorm, LineSearch>(), "delta"_a, "norm"_a, "search"_a,
             "delta applies to the patch scaled to mean edge length 1; norm is (p, offset) of the objective.\n");
    nb::class_<PatchPartition>(m, "PatchPartition", "Patches, as `partition` makes them.")
        .def(
            "__init__",
            [](PatchPartition *self, Hexes hexes, Hexes slots, Indices hex_start, Indices node_start, Indices nodes) {
                expect(hexes.size() == slots.size(), "slots: one row for each of the hexes is expected");
                expect(hex_start.size() == node_start.size(),
                       "node_start: as many numbers as in hex_start are expected");
                new (self) PatchPartition{hexes, slots, hex_start, node_start, nodes};
            },
            "hexes"_a, "slots"_a, "hex_start"_a, "node_start"_a, "nodes"_a, nb::keep_alive<1, 2>(),
            nb::keep_alive<1, 3>(), nb::keep_alive<1, 4>(), nb::keep_alive<1, 5>(), nb::keep_alive<1, 6>(),
            "hexes and slots (.., 8) are those of the patches, patch after patch, as hex_start says. Arrays are not\n"
            "copied.");
    m.def("partition", &partition, "mesh"_a, "free"_a, "size"_a, "overlap"_a, ReleaseGil(),
          "Divide the free nodes (n,) bool into connected patches of at most `size` nodes, breadth first from the\n"
          "lowest remaining node; then add to each the nodes within `overlap` steps between nodes of one hex.\n\n"
          "Returns node_start and nodes: the nodes of each patch, ascending; hex_start and patch_hexes: the hexes at\n"
          "them; slots (.., 8): the number of each corner of these hexes among the patch's nodes, -1 if it is fixed;\n"
          "all int32.");
    m.def("colours", &colours, "hex_start"_a, "patch_hexes"_a, "hexes"_a, ReleaseGil(),
          "Groups of patches that share no hex, by greedy colouring: (start, patches), int32.\n\n"
          "hexes: the number of hexes of the mesh.");
    m.def(
        "sweep",
        [](std::span<Point> points, const PatchPartition &partition, Indices groups, Indices patches,
           const PatchStepSettings &settings) {
            auto count = sweep(points, partition, groups, patches, settings);
            return std::pair{count.energies, count.derivatives};
        },
        "points"_a, "partition"_a, "groups"_a, "patches"_a, "settings"_a, ReleaseGil(),
        "Move the nodes of every patch by one Newton step together, in place, with the other nodes fixed.\n\n"
        "Group k is patches[groups[k]:groups[k + 1]] and shares no hex: the result is that of a sequential sweep for\n"
        "any number of threads. Returns the evaluations of a hex's energy in line searches, and of its derivatives.");
}

}  // namespace hexmend
