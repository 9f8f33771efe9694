#include "bindings/arrays.hpp"
#include "smoothers/worst_first.hpp"

namespace hexmend {

void bind_tournament(nb::module_ &m) {
    m.doc() = "The priority queue of `worst_first`: a tournament tree of hexes by ascending key.";
    m.def("tournament", &tournament, "key"_a, "hexes"_a,
          "The tree (2 k,) int32 of the hexes (k,) int32; tree[1] is the hex of the smallest key (m,) float64.");
    m.def("replay", &replay, "tree"_a, "key"_a, "leaf"_a,
          "Update the tree after the key of the hex at a leaf, 0 to k - 1, has changed.");
}

}  // namespace hexmend
