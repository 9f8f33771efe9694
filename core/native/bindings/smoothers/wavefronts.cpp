#include "smoothers/wavefronts.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_wavefronts(nb::module_ &m) {
    m.doc() = "In what order a sweep visits nodes, and which of them it can visit at the same time.";
    m.def(
        "levels", &levels, "ring_start"_a, "ring"_a, "start"_a, ReleaseGil(),
        "How many edges lie between each node and the nearest of those where `start` (n,) bool is true; (n,) int32.\n\n"
        "One more than the deepest level where no way leads there.");
    m.def(
        "wavefronts", &wavefronts, "start"_a, "corners"_a, "sequence"_a, ReleaseGil(),
        "The nodes of a sequence in groups, so that no hex holds two nodes of one group, and a node's group is behind\n"
        "those of all earlier nodes that share a hex with it: (group_start, nodes), both int32.\n\n"
        "Visiting group after group, each side by side, does what visiting the sequence one by one does.");
}

}  // namespace hexmend
