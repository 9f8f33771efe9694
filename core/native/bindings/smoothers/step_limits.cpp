#include "smoothers/step_limits.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_step_limits(nb::module_ &m) {
    m.doc() = "Steps of nodes: how far they may go, and where they lead.";
    m.def("shorten", &shorten, "step"_a, "points"_a, "ring_start"_a, "ring"_a, "nodes"_a, "reach"_a, ReleaseGil(),
          "Shorten the steps (k, 3) of `nodes` (k,) that are longer than `reach` mean lengths of their edges; changes\n"
          "step. Rings are `Topology.rings`.");
    m.def("displaced", &displaced, "points"_a, "nodes"_a, "step"_a, "alpha"_a, "moved"_a, ReleaseGil(),
          "Write points (n, 3), `nodes` (k,) of them displaced by alpha times their step (k, 3), to moved (n, 3).");
}

}  // namespace hexmend
