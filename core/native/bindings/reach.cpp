#include "../reach.hpp"

#include "arrays.hpp"

namespace hexmend {

void bind_reach(nb::module_ &m) {
    m.doc() = "How far the nodes may go in one step.";
    m.def("shorten", &shorten, "step"_a, "points"_a, "ring_start"_a, "ring"_a, "nodes"_a, "reach"_a, Unlocked(),
          "Shorten the steps (k, 3) of `nodes` (k,) that are longer than `reach` mean lengths of their edges; changes\n"
          "step. Rings are `Topology.rings`.");
}

}  // namespace hexmend
