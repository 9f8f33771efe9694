#include "linear/ordering.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_ordering(nb::module_ &m) {
    m.doc() = "In what order an assembled Hessian keeps the free nodes.";
    m.def(
        "slots", &slots, "hexes"_a, "ring_start"_a, "ring"_a, "free"_a, "parts"_a, ReleaseGil(),
        "The free nodes after Cuthill and McKee, in parts that share no hex, with separators between them.\n\n"
        "ring_start, ring: `Topology.rings`; free (n,) bool. Of `parts` (at least 1) as many are made as are thick\n"
        "enough.\n\n"
        "Returns the node in each slot (k,), and where the parts, and then the separators, begin and end: (2 parts,).");
}

}  // namespace hexmend
