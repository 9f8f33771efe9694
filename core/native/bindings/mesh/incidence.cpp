#include "mesh/incidence.hpp"

#include "bindings/arrays.hpp"
#include "mesh/csr.hpp"

namespace hexmend {

void bind_incidence(nb::module_ &m) {
    m.doc() = "Incidence of nodes, hexes, faces and edges; components and colours. All linear in the number of hexes.";
    m.def("node_corners", &node_corners, "hexes"_a, "n"_a, ReleaseGil(),
          "Corners of hexes at each of n nodes, as compressed rows (start (n + 1,), corners (8 m,)), both int32.\n\n"
          "Row i is corners[start[i]:start[i + 1]]: numbers 8 * hex + corner, ascending.");
    m.def("face_neighbours", &face_neighbours, "hexes"_a, "start"_a, "corners"_a, ReleaseGil(),
          "The hex behind each face, (m, 6) int32, and the number of non-manifold faces; start, corners: "
          "`node_corners`.\n"
          "\n"
          "-1 where there is no hex, or where more than two share the face. Such a face is non-manifold, a defect of "
          "the\n"
          "mesh, and is counted once per hex.");
    m.def("join", &join, "parent"_a, "items"_a, "width"_a, ReleaseGil(),
          "Connect the items of each row of `width` items; changes parent (n,) int32, at first 0 to n - 1.\n\n"
          "Union-find: parent[i] is an item of i's component, at most i.");
    m.def("component_numbers", &component_numbers, "parent"_a, ReleaseGil(),
          "Component of each item, (n,) int32, numbered in the order of their lowest items.\n");
    m.def("node_rings", &node_rings, "hexes"_a, "start"_a, "corners"_a, "max_items"_a = MOST_ITEMS, ReleaseGil(),
          "Edge neighbours of each node, ascending, as compressed rows (ring_start (n + 1,), ring), both int32.\n\n"
          "OverflowError where the rows have more than `max_items` items.");
    m.def("greedy_colours", &greedy_colours, "start"_a, "corners"_a, "chosen"_a, ReleaseGil(),
          "Colour the chosen nodes (n,) bool so that two of one hex never share a colour, greedily in node order.\n\n"
          "Returns (n,) int32, -1 for nodes that were not chosen.");
    m.def("grouped", &grouped, "colour"_a, "count"_a, ReleaseGil(),
          "Nodes grouped by colour, each group in node order: (start (count + 1,), nodes), both int32.");
    m.def("layers", &layers, "neighbours"_a, ReleaseGil(),
          "Number of hexes between each hex and the boundary, counted through faces, breadth first; (m,) int32.\n"
          "\n"
          "0 for a hex with a boundary face; one more than the deepest layer where there is no way to the boundary.");
    m.def("around", &around, "hexes"_a, "start"_a, "corners"_a, "chosen"_a, "rings"_a, ReleaseGil(),
          "The hexes `chosen` (k,) int32 and those within `rings` steps between hexes with a common node; (m,) bool.");
}

}  // namespace hexmend
