#include "smoothers/wavefronts.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_wavefronts(nb::module_ &m) {
    m.doc() = "Order of the nodes in a sweep, and groups of nodes that can be stepped at the same time.";
    m.def("levels", &levels, "ring_start"_a, "ring"_a, "start"_a, ReleaseGil(),
          "Number of edges between each node and the nearest where `start` (n,) bool is true; (n,) int32.\n"
          "\n"
          "One more than the deepest level where there is no way.");
    m.def("wavefronts", &wavefronts, "start"_a, "corners"_a, "sequence"_a, ReleaseGil(),
          "Groups of the nodes of a sequence: (group_start, nodes), both int32.\n"
          "\n"
          "No hex has two nodes of one group, and a node's group follows those of all earlier nodes of its hexes. "
          "Sweeping\n"
          "group after group, the nodes of each in parallel, equals sweeping the sequence.");
}

}  // namespace hexmend
