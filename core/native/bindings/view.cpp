#include "view/view.hpp"
#include "bindings/arrays.hpp"

namespace hexmend {

void bind_occlusion(nb::module_ m) {
    m.doc() = "Ambient occlusion of polygons.";
    m.def("normals", &normals, "points"_a, "start"_a, "places"_a, "answer"_a, ReleaseGil(),
          "Unit normals of the mean planes of polygons; writes answer (k, 3), 0 for a polygon without area.\n\n"
          "Polygon i of k has the points (p, 3) numbered places[start[i]:start[i + 1]], in order; start (k + 1,)\n"
          "and places int64. It runs on one thread, because the window's thread calls it.");
    m.def("shine", &shine, "points"_a, "start"_a, "places"_a, "normals"_a, "directions"_a, "side"_a, "light"_a,
          "whole"_a, ReleaseGil(),
          "Light from directions (j, 3) float64, unit vectors, at every corner of polygons with normals (k, 3).\n\n"
          "For each direction the polygons that face it are rasterised into a height map of `side` x `side` pixels.\n"
          "Adds the light that reaches each corner to light (start[-1],) float64, and the light without occlusion to\n"
          "whole.");
}

void bind_skin(nb::module_ m) {
    m.doc() =
        "Visible faces of a mesh of which the hexes with keep (m,) bool are shown. The functions run on one\n"
        "thread, because the window's thread calls them.";
    m.def("visible", &visible, "nodes"_a, "hexes"_a, "neighbours"_a, "keep"_a, ReleaseGil(),
          "Faces of shown hexes behind which no hex is shown.\n\n"
          "nodes is the number of nodes of the mesh; neighbours (m, 6) int32 the hex behind each face, -1 for\n"
          "none. Returns the nodes of these faces (u,), the faces as positions among them (k, 4), and the hex of\n"
          "each (k,), all int32.");
    m.def("edges_kept", &edges_kept, "hexes"_a, "start"_a, "corners"_a, "edges"_a, "keep"_a, "answer"_a, ReleaseGil(),
          "Edges (k, 2) int32 that a shown hex has; writes answer (k,) bool.\n\n"
          "start, corners: `Topology.node_corners`.");
}

}  // namespace hexmend
