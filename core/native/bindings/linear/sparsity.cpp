#include "linear/sparsity.hpp"

#include "bindings/arrays.hpp"
#include "mesh/csr.hpp"

namespace hexmend {

void bind_sparsity(nb::module_ &m) {
    m.doc() = "Sparsity of a Hessian: the 3 x 3 blocks above its diagonal, one for each pair of free nodes of a hex.";
    m.attr("PAIRS") = PAIRS;
    m.def(
        "pattern", &pattern, "slots"_a, "nodes"_a, "start"_a, "corners"_a, "max_items"_a = MOST_ITEMS, ReleaseGil(),
        "Blocks above the diagonal, and the block that each pair of a hex's corners adds to; all int32.\n"
        "\n"
        "slots (m, 8): the slot of each corner, -1 if it is fixed; nodes (k,): the node of each slot; start, corners:\n"
        "`Topology.node_corners`. Returns row_start (k + 1,) and columns, ascending within a row; and target (m, 28), "
        "of\n"
        "the pairs 01, 02... 07, 12...: the block, -1 where a corner is fixed, -2 - slot where both are one node.\n"
        "OverflowError where there are more than `max_items` blocks.");
}

}  // namespace hexmend
