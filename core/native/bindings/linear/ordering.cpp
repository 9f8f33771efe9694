#include "linear/ordering.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_ordering(nb::module_ &m) {
    m.doc() = "Ordering of the free nodes in an assembled Hessian.";
    m.def(
        "slots", &slots, "hexes"_a, "ring_start"_a, "ring"_a, "free"_a, "parts"_a, ReleaseGil(),
        "The free nodes after Cuthill and McKee, in parts that share no hex, followed by the separators between them.\n"
        "\n"
        "ring_start, ring: `Topology.rings`; free (n,) bool. The number of parts, at least 1, is reduced until none "
        "is\n"
        "too thin. Returns the node in each slot (k,), and the bounds of the parts and then the separators, (2 "
        "parts,).");
}

}  // namespace hexmend
