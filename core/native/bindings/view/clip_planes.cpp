#include "view/clip_planes.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_clip_planes(nb::module_ &m) {
    m.doc() =
        "Sides of planes on which hexes lie. A point is beyond a plane where x . normal > offset; normals (k, 3) and\n"
        "offsets (k,) float64. The functions run on one thread, because the window's thread calls them.";
    m.def("centres_kept", &centres_kept, "points"_a, "hexes"_a, "normals"_a, "offsets"_a, "notch"_a, "kept"_a,
          ReleaseGil(),
          "Hexes whose centre remains after the cut; writes kept (m,) bool.\n"
          "\n"
          "With `notch` what is beyond all planes is cut away, else what is beyond any of them.");
    m.def("touched", &touched, "points"_a, "hexes"_a, "normals"_a, "offsets"_a, "notch"_a, "answer"_a, ReleaseGil(),
          "Planes that cross or touch each hex where the section is visible; writes answer (m * k,) bool, hex by hex.\n"
          "\n"
          "None does where the hex lies wholly beyond one of them or, with `notch`, wholly before one.");
}

}  // namespace hexmend
