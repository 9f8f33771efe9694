#include "../couplings.hpp"

#include "arrays.hpp"

namespace hexmend {

void bind_couplings(nb::module_ &m) {
    m.doc() = "Which free nodes share a hex: the pattern of a Hessian's 3 x 3 blocks above its diagonal.";
    m.attr("PAIRS") = PAIRS;
    m.def("rows", &rows, "slots"_a, "nodes"_a, "start"_a, "corners"_a, Unlocked(),
          "Rows of the blocks above the diagonal: (row_start (k + 1,), columns), int32, ascending within a row.\n\n"
          "slots (m, 8): the slot of each corner, -1 if it is fixed; nodes (k,): the node of each slot; start,\n"
          "corners: `Topology.node_corners`.");
    m.def("targets", &targets, "slots"_a, "row_start"_a, "columns"_a, "target"_a, Unlocked(),
          "Which block each pair of a hex's corners, 01, 02... 07, 12..., adds to; writes target (m, 28) int32.\n\n"
          "-1 where a corner is fixed, -2 - slot where both are one node: that node's own block.");
}

}  // namespace hexmend
