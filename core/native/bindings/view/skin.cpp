#include "view/skin.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_skin(nb::module_ &m) {
    m.doc() =
        "Visible faces of a mesh of which the hexes with keep (m,) bool are shown. The functions run on one thread,\n"
        "because the window's thread calls them.";
    m.def("visible", &visible, "nodes"_a, "hexes"_a, "neighbours"_a, "keep"_a, ReleaseGil(),
          "Faces of shown hexes behind which no hex is shown.\n"
          "\n"
          "nodes is the number of nodes of the mesh; neighbours (m, 6) int32 the hex behind each face, -1 for none.\n"
          "Returns the nodes of these faces (u,), the faces as positions among them (k, 4), and the hex of each (k,),\n"
          "all int32.");
    m.def(
        "faces_of", &faces_of, "hexes"_a, "neighbours"_a, "keep"_a, "chosen"_a, "hidden"_a, ReleaseGil(),
        "Faces of the hexes with chosen (m,) bool, each hex with its own eight nodes; returns the same as `visible`.\n"
        "\n"
        "Without `hidden`, only faces behind which no hex is shown.");
    m.def("outer", &outer, "neighbours"_a, "keep"_a, "answer"_a, ReleaseGil(),
          "Hexes that are shown and have a visible face; writes answer (m,) bool.");
    m.def("shrunk", &shrunk, "points"_a, "nodes"_a, "shrink"_a, "places"_a, ReleaseGil(),
          "Corners of hexes, nodes (8 k,) int32, moved by the fraction `shrink` towards their mean; writes places\n"
          "(8 k, 3).");
    m.def("edges_kept", &edges_kept, "hexes"_a, "start"_a, "corners"_a, "edges"_a, "keep"_a, "answer"_a, ReleaseGil(),
          "Edges (k, 2) int32 that a shown hex has; writes answer (k,) bool.\n"
          "\n"
          "start, corners: `Topology.node_corners`.");
}

}  // namespace hexmend
