#include "smoothers/getme.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_getme(nb::module_ &m) {
    m.doc() =
        "GETMe: nodes go to means of the places that their hexes give them. start, corners: "
        "`Topology.node_corners`.";
    m.def("weighted_means", &weighted_means, "places"_a, "weights"_a, "start"_a, "corners"_a, "nodes"_a, "targets"_a,
          ReleaseGil(),
          "Write, for each of `nodes`, the mean of its places (m, 8, 3) in its hexes by the hexes' weights (m,);\n"
          "targets (n, 3).");
    m.def("relax", &relax, "points"_a, "hexes"_a, "start"_a, "corners"_a, "sound"_a, "harmed"_a, "moved"_a,
          ReleaseGil(),
          "Shorten the moves of nodes until no hex that was sound is inverted; returns how many were shortened.\n\n"
          "points (n, 3): before the move. sound (m,) bool: whether a hex was sound there. harmed (k,) int32: hexes\n"
          "that are not sound any more at `moved` (n, 3), which is changed. Round after round, the nodes of all\n"
          "inverted hexes halve their moves, the fourth time to nothing; a hex none of whose nodes moves is what it\n"
          "was, so the rounds end.");
}

}  // namespace hexmend
