#include "mesh/faces.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_faces(nb::module_ &m) {
    m.doc() = "Metrics of every hex from its six faces. Each function writes arrays (m,) float64.";
    m.def("angles", &angles, "points"_a, "hexes"_a, "smallest"_a, "largest"_a, ReleaseGil(),
          "Angles between adjacent edges of the faces, four corners of six faces, in degrees; 0 and 180 where an edge "
          "has\n"
          "no length.");
    m.def("warpage", &warpage, "points"_a, "hexes"_a, "worst"_a, ReleaseGil(),
          "Greatest over the faces of 1 - min((n0 . n2)^3, (n1 . n3)^3), n the unit normals at the face's corners; 2 "
          "where\n"
          "a corner of a face has no normal.");
    m.def("volume", &volume, "points"_a, "hexes"_a, "enclosed"_a, ReleaseGil(),
          "Volume inside the six bilinear faces, that of Verdict's 24 tetrahedra: negative for a hex turned inside "
          "out.\n\n"
          "Of a face a, b, c, d it is (a + b + c + d) . (c - a) x (d - b) / 24, in the cube of the mesh's unit of "
          "length.");
}

}  // namespace hexmend
