#include "boundary/closest_point.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_closest_point(nb::module_ &m) {
    m.doc() =
        "The closest point of a surface, by a tree of bounding boxes for each of its curves and patches.\n"
        "\n"
        "A piece, a row of pieces (k, 3) int32, is a triangle (a, b, c) of points (n, 3), or a segment (a, b, b).";
    nb::class_<BoxTrees>(m, "BoxTrees", "Trees over pieces.")
        .def(
            "__init__",
            [](BoxTrees *self, Points points, std::span<const Piece> pieces, std::span<const Box> boxes,
               std::span<const TreeLink> links) {
                expect(links.size() == boxes.size(), "links: one for each of the boxes is expected");
                new (self) BoxTrees{points, pieces, boxes, links};
            },
            "points"_a, "pieces"_a, "boxes"_a, "links"_a, nb::keep_alive<1, 2>(), nb::keep_alive<1, 3>(),
            nb::keep_alive<1, 4>(), nb::keep_alive<1, 5>(),
            "pieces (k, 3) int32 are in the order that `build_trees` returns, with its boxes (b, 6) float64 and links\n"
            "(b, 2) int32. Arrays are not copied.");
    m.def("build_trees", &build_trees, "points"_a, "pieces"_a, "start"_a, ReleaseGil(),
          "Trees over pieces: tree t is made of pieces[start[t]:start[t + 1]], one at least; start (t + 1,) int32.\n\n"
          "Returns the order (k,) int32 that the pieces are to be put in, boxes (b, 6) float64 and links (b, 2) int32\n"
          "of all trees, and the box that is the root of each, (t,) int32.");
    m.def("refit", &refit, "points"_a, "pieces"_a, "links"_a, "boxes"_a, ReleaseGil(),
          "Write the boxes of trees whose points have moved; pieces are in the order that `build_trees` returns.");
    m.def(
        "closest", &closest, "trees"_a, "x"_a, "roots"_a, "enough"_a, "piece"_a, "places"_a, "weights"_a, ReleaseGil(),
        "The point closest to each of x (j, 3) in the tree of its root (j,).\n"
        "\n"
        "A point at a distance of at most `enough` counts as closest. Writes the piece (j,) int32, -1 where x is not\n"
        "finite, the point on it (j, 3), and its barycentric weights in the piece (j, 3).");
}

}  // namespace hexmend
