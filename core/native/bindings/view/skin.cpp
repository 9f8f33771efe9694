#include "view/skin.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_skin(nb::module_ &m) {
    m.doc() =
        "What is seen of a mesh of which some hexes are kept, keep (m,) bool; on one thread, because a window's\n"
        "thread asks.";
    m.def("visible", &visible, "nodes"_a, "hexes"_a, "neighbours"_a, "keep"_a, ReleaseGil(),
          "Faces of kept hexes that no kept hex is behind.\n\n"
          "nodes is how many the mesh has; neighbours (m, 6) int32 the hex behind each face, -1 for none. Makes the "
          "nodes\n"
          "that such faces use (u,), the faces as places among them (k, 4), and the hex of each (k,), all int32.");
    m.def("faces_of", &faces_of, "hexes"_a, "neighbours"_a, "keep"_a, "chosen"_a, "hidden"_a, ReleaseGil(),
          "Faces of chosen hexes, chosen (m,) bool, each of which has eight nodes of its own; makes what visible "
          "makes.\n\n"
          "Without hidden they are those that no kept hex is behind.");
    m.def("outer", &outer, "neighbours"_a, "keep"_a, "answer"_a, ReleaseGil(),
          "Whether a hex is kept and has a face that no kept hex is behind; writes answer (m,) bool.");
    m.def("shrunk", &shrunk, "points"_a, "nodes"_a, "shrink"_a, "places"_a, ReleaseGil(),
          "Where nodes (8 k,) int32 of whole hexes, eight by eight, are drawn nearer to their mean by a share of the "
          "way;\n"
          "writes places (8 k, 3).");
    m.def("edges_kept", &edges_kept, "hexes"_a, "start"_a, "corners"_a, "edges"_a, "keep"_a, "answer"_a, ReleaseGil(),
          "Whether a kept hex has each of the edges (k, 2) int32; writes answer (k,) bool.\n\n"
          "start and corners are the rows of the corners at every node.");
}

}  // namespace hexmend
