#include "smoothers/worst_first.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_worst_first(nb::module_ &m) {
    m.doc() = "Sequential GETMe: the worst hex takes its element step, again and again, from a priority queue.";
    m.def("sweep", &sweep, "points"_a, "hexes"_a, "start"_a, "corners"_a, "free"_a, "candidates"_a, "q"_a, "sound"_a,
          "s"_a, "rho"_a, "penalty"_a, "setback"_a, ReleaseGil(),
          "Take as many element steps as there are candidates, each of the hex that is worst at the time; returns the\n"
          "number of rejected steps.\n"
          "\n"
          "A step that inverts a sound hex is rejected. After its step a hex ranks as better by `penalty` if the step "
          "was\n"
          "accepted and by `setback` if it was rejected, so that it is not chosen for ever. points (n, 3), changed, "
          "end at\n"
          "the best state reached: fewest inverted hexes, then highest q_min, then highest q_mean. free (n,) bool;\n"
          "candidates (k,) int32: the hexes that have a free node. q (m,) float64 and sound (m,) bool, as measured at\n"
          "points, are changed to those of the last state, which need not be the best. s and rho: scale and blend of "
          "the\n"
          "element step. start, corners: `Topology.node_corners`.");
}

}  // namespace hexmend
