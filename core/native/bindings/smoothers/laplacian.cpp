#include "smoothers/laplacian.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_laplacian(nb::module_ &m) {
    m.doc() = "Laplacian sweeps: a node goes to the mean of its edge neighbours. Rings are `Topology.rings`.";
    m.def("in_place", &in_place, "points"_a, "ring_start"_a, "ring"_a, "nodes"_a, ReleaseGil(),
          "Algorithm 3.1: node after node, each seeing where those before it went; changes points (n, 3).");
    m.def("simultaneous", &simultaneous, "points"_a, "ring_start"_a, "ring"_a, "nodes"_a, "moved"_a, ReleaseGil(),
          "All nodes at once, each seeing where the others were; writes moved (n, 3).");
    m.def("guarded", &guarded, "points"_a, "hexes"_a, "start"_a, "corners"_a, "ring_start"_a, "ring"_a, "nodes"_a,
          "keep_least_quality"_a, ReleaseGil(),
          "Algorithm 3.1 in which a move that harms is taken back; changes points (n, 3), returns how many were.\n\n"
          "A move harms if it inverts an attached hex that was not inverted, or, with keep_least_quality, if it\n"
          "lowers the least q(H) of the attached hexes. start, corners: `Topology.node_corners`.");
}

}  // namespace hexmend
