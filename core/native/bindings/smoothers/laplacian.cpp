#include "smoothers/laplacian.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_laplacian(nb::module_ &m) {
    m.doc() =
        "Laplacian sweeps: a node moves to the mean of its edge neighbours. ring_start, ring: `Topology.rings`.\n"
        "\n"
        "With a surface the means of nodes that slide are projected onto it.";
    m.def("in_place", &in_place, "points"_a, "ring_start"_a, "ring"_a, "nodes"_a, "surface"_a.none() = nb::none(),
          ReleaseGil(), "Algorithm 3.1: one node after another; changes points (n, 3).");
    m.def("simultaneous", &simultaneous, "points"_a, "ring_start"_a, "ring"_a, "nodes"_a, "moved"_a, ReleaseGil(),
          "All nodes at once, from the old positions of the others; writes moved (n, 3).");
    m.def("smart_sweep", &smart_sweep, "points"_a, "mesh"_a, "ring_start"_a, "ring"_a, "nodes"_a,
          "keep_least_quality"_a, "surface"_a.none() = nb::none(), ReleaseGil(),
          "Smart Laplacian: Algorithm 3.1 without moves that do harm; changes points (n, 3), returns the number of\n"
          "rejected moves.\n"
          "\n"
          "A move does harm if it inverts a sound hex or, with keep_least_quality, lowers the least q(H) of the hexes "
          "at\n"
          "the node.");
}

}  // namespace hexmend
