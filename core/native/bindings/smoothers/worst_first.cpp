#include "smoothers/worst_first.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_worst_first(nb::module_ &m) {
    m.doc() = "The second stage of GETMe: the worst hex takes its step, again and again, from a priority queue.";
    m.def("sweep", &sweep, "points"_a, "hexes"_a, "start"_a, "corners"_a, "free"_a, "candidates"_a, "q"_a, "sound"_a,
          "s"_a, "rho"_a, "penalty"_a, "setback"_a, ReleaseGil(),
          "As many element steps as there are candidates, each of the hex that is worst at the time; returns how many\n"
          "were taken back.\n\n"
          "A step that would invert a sound hex is taken back. The hex that took a step pays a penalty, lest it be\n"
          "chosen for ever: it counts as better by `penalty` where the step was kept, by `setback` where it was taken\n"
          "back. points (n, 3), changed, end at the best state on the way: fewest inverted hexes, then highest q_min,\n"
          "then highest q_mean. free (n,) bool; candidates (k,) int32: the hexes that have a free node. q (m,)\n"
          "float64 and sound (m,) bool, as measured at points, are changed to those of the last state, which need\n"
          "not be the best. start, corners: `Topology.node_corners`.");
}

}  // namespace hexmend
