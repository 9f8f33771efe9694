#include "smoothers/step_limits.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_step_limits(nb::module_ &m) {
    m.doc() = "Steps of nodes: their limits, and the points that they lead to.";
    m.def("shorten", &shorten, "step"_a, "points"_a, "ring_start"_a, "ring"_a, "nodes"_a, "reach"_a, ReleaseGil(),
          "Shorten the steps (k, 3) of `nodes` (k,) that are longer than `reach` times the mean length of the node's "
          "edges;\n"
          "changes step. ring_start, ring: `Topology.rings`.");
    m.def("displaced", &displaced, "points"_a, "nodes"_a, "step"_a, "alpha"_a, "moved"_a, ReleaseGil(),
          "Points (n, 3) with `nodes` (k,) displaced by alpha times their steps (k, 3); writes moved (n, 3).");
}

}  // namespace hexmend
