#include "mesh/structure.hpp"

#include "bindings/arrays.hpp"
#include "mesh/csr.hpp"

namespace hexmend {

void bind_structure(nb::module_ &m) {
    m.doc() = "Valence of edges, from which the block structure of a mesh follows.";
    m.def("edges", &edges, "hexes"_a, "start"_a, "corners"_a, "neighbours"_a, "max_items"_a = MOST_ITEMS, ReleaseGil(),
          "Every edge once, with the number of hexes around it: (ends (e, 2) int32, valence (e,) int32, outside (e,)\n"
          "bool).\n\n"
          "ends: the lower node first, ascending. valence: hexes that have the edge; one that has it twice, its nodes\n"
          "being one, counts once. outside: True for an edge of a boundary face. start, corners and neighbours are\n"
          "those of `incidence`. OverflowError where there are more than `max_items` edges.");
}

}  // namespace hexmend
