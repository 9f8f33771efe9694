#include "smoothers/getme.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_getme(nb::module_ &m) {
    m.doc() =
        "Simultaneous GETMe: a node moves to the weighted mean of the targets that its hexes' element steps give it.";
    m.def("weighted_means", &weighted_means, "places"_a, "weights"_a, "mesh"_a, "nodes"_a, "targets"_a, ReleaseGil(),
          "Means of the targets, places (m, 8, 3), of each of `nodes` over its hexes, by their weights (m,); writes\n"
          "targets (n, 3).");
    m.def("relax", &relax, "points"_a, "mesh"_a, "sound"_a, "harmed"_a, "moved"_a, ReleaseGil(),
          "Shorten moves until no hex that was sound is inverted; returns the number of shortened moves.\n"
          "\n"
          "points (n, 3): before the move. sound (m,) bool: hexes that were sound there. harmed (k,) int32: those that "
          "are\n"
          "inverted at `moved` (n, 3), which is changed. In each round the nodes of all inverted hexes halve their "
          "moves,\n"
          "the fourth time to nothing; a hex none of whose nodes moves is as it was, so the rounds end.");
}

}  // namespace hexmend
