#include "view/clip_planes.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_clip_planes(nb::module_ &m) {
    m.doc() =
        "On which side of planes hexes lie; on one thread, because a window's thread asks.\n\n"
        "normals (k, 3) and offsets (k,) float64: a point lies beyond a plane where x . normal > offset.";
    m.def("centres_kept", &centres_kept, "points"_a, "hexes"_a, "normals"_a, "offsets"_a, "notch"_a, "kept"_a,
          ReleaseGil(),
          "Whether the centre of each hex is not cut away; writes kept (m,) bool.\n\n"
          "With notch what lies beyond all planes is cut away, else what lies beyond one of them.");
    m.def("touched", &touched, "points"_a, "hexes"_a, "normals"_a, "offsets"_a, "notch"_a, "answer"_a, ReleaseGil(),
          "Which planes cross or touch each hex where that can be seen; writes answer (m * k,) bool, hex by hex.\n\n"
          "None does where the hex lies wholly beyond one of them, or, with notch, wholly before.");
}

}  // namespace hexmend
