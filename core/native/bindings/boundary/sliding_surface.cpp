#include "smoothers/sliding.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_sliding_surface(nb::module_ &m) {
    m.doc() =
        "The surface on which nodes of the boundary slide: sweeps that take one project every trial point onto it.";
    nb::class_<BoundaryQuads>(m, "BoundaryQuads",
                              "Quads of the boundary at the nodes that slide. A step that inverts one is rejected.\n\n"
                              "Inverted is a quad whose normal points against `outward`; one that is already may stay "
                              "so.")
        .def(
            "__init__",
            [](BoundaryQuads *self, Indices start, Indices corners, std::span<const Quad> quads, Points outward) {
                expect(!start.empty() && start.back() == static_cast<std::int64_t>(corners.size()),
                       "start: its last number is expected to be the length of corners");
                expect(outward.size() == quads.size(), "outward: one for each of the quads is expected");
                new (self) BoundaryQuads{start, corners, quads, outward};
            },
            "start"_a, "corners"_a, "quads"_a, "outward"_a, nb::keep_alive<1, 2>(), nb::keep_alive<1, 3>(),
            nb::keep_alive<1, 4>(), nb::keep_alive<1, 5>(),
            "corners holds 4 * quad + corner of each of k sliding nodes, from start (k + 1,) on, all int32; quads (f, "
            "4)\n"
            "int32; outward (f, 3) float64 are normals of the original surface, 0 where it has none. Arrays are not\n"
            "copied.");
    nb::class_<SlidingSurface>(m, "SlidingSurface", "Curves and patches, with the nodes that slide on them.")
        .def(
            "__init__",
            [](SlidingSurface *self, Indices slots, Indices roots, const BoxTrees &trees, const BoundaryQuads &quads) {
                expect(quads.start.size() == roots.size() + 1, "quads: rows of each of the roots are expected");
                new (self) SlidingSurface{slots, roots, trees, quads};
            },
            "slots"_a, "roots"_a, "trees"_a, "quads"_a, nb::keep_alive<1, 2>(), nb::keep_alive<1, 3>(),
            nb::keep_alive<1, 4>(), nb::keep_alive<1, 5>(),
            "slots (n,) int32 numbers the nodes that slide, -1 for others; roots (k,) int32 are the roots of the trees "
            "of\n"
            "their curves and patches. Arrays are not copied.");
    m.def("newly_inverted", &newly_inverted, "before"_a, "after"_a, "quads"_a, "outward"_a, "inverted"_a, ReleaseGil(),
          "Write inverted (f,) bool: True for a quad that is inverted at the points after and was not before.");
}

}  // namespace hexmend
