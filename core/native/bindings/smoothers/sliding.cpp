#include "smoothers/sliding.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_sliding(nb::module_ &m) {
    m.doc() =
        "Sweeps in which nodes of the boundary slide: whatever place is tried, they are put back on their own curve "
        "or\n"
        "patch first.\n\n"
        "slots (n,) int32 numbers the nodes that slide, -1 of others; roots (k,) int32 are their trees, and vertices,\n"
        "pieces, boxes, links those of `hexmend.kernels.closest_point`. quads (f, 4) int32 are the boundary's, outward "
        "(f, "
        "3)\n"
        "their normals at first, or 0; quads_at holds 4 * quad + corner of each node that slides, from quads_start\n"
        "(k + 1,) on. A step that turns a quad against that normal is none; one that is turned may be.";
    m.def("local", &sliding_local, "points"_a, "hexes"_a, "start"_a, "corners"_a, "groups"_a, "nodes"_a, "direction"_a,
          "delta"_a, "power"_a, "first"_a, "shrink"_a, "c1"_a, "cuts"_a, "tangents"_a, "slots"_a, "roots"_a,
          "vertices"_a, "pieces"_a, "boxes"_a, "links"_a, "quads_start"_a, "quads_at"_a, "quads"_a, "outward"_a,
          ReleaseGil(),
          "`hexmend.kernels.local.sweep`; nodes that slide step along the surface, T'g and T'HT being their\n"
          "derivatives, and the line search asks for the energy where they are put back. tangents (k, 6): two\n"
          "directions of each where it is, the second 0 on a curve.");
    m.def("laplacian", &sliding_laplacian, "points"_a, "ring_start"_a, "ring"_a, "nodes"_a, "slots"_a, "roots"_a,
          "vertices"_a, "pieces"_a, "boxes"_a, "links"_a, "quads_start"_a, "quads_at"_a, "quads"_a, "outward"_a,
          ReleaseGil(), "`hexmend.kernels.laplacian.in_place`, each mean put back.");
    m.def("guarded", &sliding_guarded, "points"_a, "hexes"_a, "start"_a, "corners"_a, "ring_start"_a, "ring"_a,
          "nodes"_a, "keep_least_quality"_a, "slots"_a, "roots"_a, "vertices"_a, "pieces"_a, "boxes"_a, "links"_a,
          "quads_start"_a, "quads_at"_a, "quads"_a, "outward"_a, ReleaseGil(),
          "`hexmend.kernels.laplacian.guarded`, each mean put back before it is judged.");
    m.def("worst_first", &sliding_worst_first, "points"_a, "hexes"_a, "start"_a, "corners"_a, "free"_a, "candidates"_a,
          "q"_a, "sound"_a, "s"_a, "rho"_a, "penalty"_a, "setback"_a, "slots"_a, "roots"_a, "vertices"_a, "pieces"_a,
          "boxes"_a, "links"_a, "quads_start"_a, "quads_at"_a, "quads"_a, "outward"_a, ReleaseGil(),
          "`hexmend.kernels.worst_first.sweep`, each element's step put back before it is judged.");
    m.def("turned", &turned, "before"_a, "after"_a, "quads"_a, "outward"_a, "is"_a, ReleaseGil(),
          "Whether a quad is turned after and was not before: is (f,).");
}

}  // namespace hexmend
