#include <nanobind/stl/optional.h>

#include "bindings/arrays.hpp"
#include "boundary/closest_point.hpp"
#include "boundary/closest_point_cache.hpp"
#include "boundary/near_points.hpp"
#include "boundary/surface_fit.hpp"
#include "boundary/surface_points.hpp"
#include "boundary/tangents.hpp"
#include "smoothers/sliding.hpp"

namespace hexmend {

void bind_closest_point(nb::module_ m) {
    m.doc() =
        "The closest point of a surface, by a tree of bounding boxes for each of its curves and patches.\n\n"
        "A piece, a row of pieces (k, 3) int32, is a triangle (a, b, c) of points (n, 3), or a segment (a, b, b).";
    nb::class_<BoxTrees>(m, "BoxTrees", "Trees over pieces.")
        .def(ViewOf<Points, std::span<const Piece>, std::span<const ChildSide>, std::span<const ChildLinks>>(),
             "points"_a, "pieces"_a, "boxes"_a, "links"_a,
             "pieces (k, 3) int32 are in the order that `build_trees` returns, with its boxes (6 b, 4) float64 and\n"
             "links (b, 4) int32.");
    nb::class_<ClosestPointCache>(m, "ClosestPointCache",
                                  "Pieces near to points that move little from one query to the next.\n\n"
                                  "They prove in most queries which point is the closest, without a search of the\n"
                                  "tree. Results do not depend on them.")
        .def(nb::init<const BoxTrees &, Indices>(), "trees"_a, "roots"_a, nb::keep_alive<1, 2>(),
             "For a point in each slot, in the tree of its root (s,) int32.")
        .def("closest", &closest_of_slots, "slots"_a, "x"_a, "piece"_a, "places"_a, "weights"_a, ReleaseGil(),
             "The point closest to each of x (j, 3), the points in slots (j,) int32.\n\n"
             "Writes the piece (j,) int32, -1 where x is not finite, the point on it (j, 3), and its barycentric\n"
             "weights in the piece (j, 3).");
    m.def("build_trees", &build_trees, "points"_a, "pieces"_a, "start"_a, ReleaseGil(),
          "Trees over pieces: tree t is made of pieces[start[t]:start[t + 1]], one at least; start (t + 1,) int32.\n\n"
          "Returns the order (k,) int32 that the pieces are to be put in, boxes (6 b, 4) float64 and links (b, 4)\n"
          "int32 of the nodes of all trees, and the node that is the root of each, (t,) int32.");
    m.def("refit", &refit, "points"_a, "pieces"_a, "links"_a, "boxes"_a, ReleaseGil(),
          "Write the boxes of trees whose points have moved; pieces are in the order that `build_trees` returns.");
    m.def("closest", &closest, "trees"_a, "x"_a, "roots"_a, "enough"_a, "piece"_a, "places"_a, "weights"_a,
          ReleaseGil(),
          "The point closest to each of x (j, 3) in the tree of its root (j,).\n\n"
          "A point at a distance of at most `enough` counts as closest. Writes the piece (j,) int32, -1 where x is\n"
          "not finite, the point on it (j, 3), and its barycentric weights in the piece (j, 3). On entry, piece has\n"
          "one of the tree that is near and shortens the search, or -1.");
    nb::class_<NearPoints>(m, "NearPoints", "Points that were near samples before.")
        .def(ViewOf<std::span<std::int32_t>, std::span<Barycentric>, std::span<Point>, Indices>(), "piece"_a,
             "weights"_a, "places"_a, "roots"_a,
             "The piece (s,) int32 on which each lies, -1 for none, its barycentric weights there (s, 3), and its\n"
             "position (s, 3), infinite for none; the root (s,) int32 of the tree that is searched for each. All\n"
             "but the roots are written.");
    m.def("means_beyond", &means_beyond, "trees"_a, "points"_a, "samples"_a, "examined"_a, "limits"_a, "near"_a,
          "beyond"_a, ReleaseGil(),
          "Write beyond (s,) bool: True where the mean of the four points of a row of samples (s, 4) int32, which\n"
          "must exist, is further from its tree than its limit (s,). False where examined (s,) bool is.\n"
          "Points that are found become the near ones.");
    m.def(
        "samples_beyond",
        [](Points points, std::span<const Piece> pieces, std::span<const ChildLinks> links, std::span<ChildSide> boxes,
           Points x, std::span<const bool> examined, Numbers limits, const NearPoints &near) {
            return samples_beyond({points, pieces, links, boxes}, x, examined, limits, near);
        },
        "points"_a, "pieces"_a, "links"_a, "boxes"_a, "x"_a, "examined"_a, "limits"_a, "near"_a, ReleaseGil(),
        "The numbers, ascending int32, of the examined (s,) bool of x (s, 3) that are further than their limits (s,)\n"
        "from their trees, whose points have moved.\n\n"
        "Boxes are written where a search is needed. Points that are found become the near ones, without their\n"
        "positions.");
    nb::class_<BandSamples>(m, "BandSamples", "Samples of a boundary and of the surface on which it slides.")
        .def(ViewOf<std::span<const std::array<Node, 4>>, std::span<const std::array<Node, 4>>,
                    std::span<const std::int64_t>, Indices>(),
             "boundary"_a, "faces"_a, "face_of_piece"_a, "pieces"_a,
             "A sample of the boundary is the mean of four nodes, boundary (s, 4) int32. A sample of the surface is\n"
             "near to one of pieces (t,) int32, -1 for none, of a face of the boundary, faces (f, 4) int32 by\n"
             "face_of_piece (p,) int64. Numbers must exist.");
    m.def(
        "moved_samples", &moved_samples, "samples"_a, "points"_a, "earlier"_a, "boundary_before"_a, "surface_before"_a,
        "boundary"_a, "surface"_a, ReleaseGil(),
        "Mark samples of the boundary, boundary (s,) bool, and of the surface, surface (t,) bool: the samples marked\n"
        "before, and those with a node that differs between points and earlier, both (n, 3). The nodes of a sample of\n"
        "the surface are the nodes of the face near to it.");
    m.def("numbers_of_different_points", &numbers_of_different_points, "points"_a, ReleaseGil(),
          "The number (n,) int32 of each of points (n, 3) among the different ones, in the order in which they first\n"
          "appear.");
    m.def("edges_of_faces", &edges_of_faces, "faces"_a, "width"_a, "nodes"_a, ReleaseGil(),
          "The edges of faces: nodes (e, 2) int32, the lower one first, ascending; the sides on each (s,) int32,\n"
          "ascending; and where those of each edge begin, (e + 1,) int32.\n\n"
          "faces (k * width,) int32 are the nodes of faces one after the other, below `nodes`; its side s runs from\n"
          "the node in place s to the next of the face. A side between equal nodes lies on no edge.");
    m.def("count_fans", &count_fans, "faces"_a, "width"_a, "sides"_a, "first"_a, "nodes"_a, ReleaseGil(),
          "The number of fans at each of `nodes` nodes, faces connected by edges (nodes,) int32.\n\n"
          "faces (k * width,) int32 are the nodes of faces one after the other; its side s runs from the node in\n"
          "place s to the next of the face. Edge e has sides[first[e]:first[e + 1]], all int32.");
    m.def("quantiles_around", &quantiles_around, "edges"_a, "start"_a, "ends"_a, "values"_a, "some"_a, "most"_a,
          "share"_a, ReleaseGil(),
          "Quantile of the values around each of some edges (s,) int32, (s,) float64.\n\n"
          "Around an edge are those at its two nodes and at the neighbours of these, without the edge itself and\n"
          "without values above `most`; the quantile is 0 where none is left. edges (e, 2) int32 have values (e,);\n"
          "those at node i are ends[start[i]:start[i + 1]] // 2. A share of the values is less than the quantile.");
    m.def(
        "vertex_normals", &vertex_normals, "points"_a, "triangles"_a, "patch"_a, "normals"_a, ReleaseGil(),
        "Write the unit normals (3 t, 3) at the corners of each of triangles (t, 3) int32: the mean over those of the\n"
        "same patch (t,) int32 at the vertex, weighted by their angles; 0 where they have none.");
    m.def("means", &means, "points"_a, "nodes"_a, "x"_a, ReleaseGil(),
          "Write the mean (j, 3) of the four points of each row of nodes (j, 4) int32, which must exist.");
}

template <class Real> void bind_fit_hessian(nb::module_ m) {
    m.def(
        "hessian",
        [](std::span<const SampleNodes> slots, std::span<double> distances, std::span<Point> vectors,
           std::span<Point> directions, std::span<SampleWeights> weights, Numbers first, Numbers second,
           std::span<const bool> of_line, Indices row_start, Indices columns,
           std::span<std::array<Real, 9>> off_diagonal, std::span<std::array<Real, 6>> diagonal) {
            fit_hessian<Real>(slots, {distances, vectors, directions, {}, weights}, {first, second, of_line}, row_start,
                              columns, off_diagonal, diagonal);
        },
        "slots"_a, "distances"_a, "vectors"_a, "directions"_a, "weights"_a, "first"_a, "second"_a, "of_line"_a,
        "row_start"_a, "columns"_a, "off_diagonal"_a, "diagonal"_a, ReleaseGil(),
        "Add second derivatives of samples to a matrix, see `assembly.assemble`.\n\n"
        "slots (k, 4) int32 of their nodes, -1 for none; distances, vectors, directions and weights as they are\n"
        "written by `distances`; first and second (k,): derivatives of the cost by the distance, the first divided\n"
        "by it; of_line (k,) bool: near a line or a point, else near a plane; row_start and columns of the blocks\n"
        "above the diagonal.");
}

void bind_surface_fit(nb::module_ m) {
    m.doc() = "Distances between a boundary that moves and the surface that it had, as terms of an energy.";
    nb::class_<FitSamples>(m, "FitSamples", "Samples of a boundary and of its surface.")
        .def(
            "__init__",
            [](FitSamples *self, std::span<const SampleNodes> nodes, Points first, Indices slots, Indices roots,
               const ClosestPointCache &surface, Points directions, std::span<const std::array<Node, 4>> faces) {
                expect(have_rows(nodes.size(), first, slots, roots),
                       "nodes, first, slots and roots have different lengths: expected a row a sample");
                new (self) FitSamples{nodes, first, slots, roots, &surface, directions, faces};
            },
            "nodes"_a, "first"_a, "slots"_a, "roots"_a, "surface"_a, "directions"_a, "faces"_a, nb::keep_alive<1, 2>(),
            nb::keep_alive<1, 3>(), nb::keep_alive<1, 4>(), nb::keep_alive<1, 5>(), nb::keep_alive<1, 6>(),
            nb::keep_alive<1, 7>(), nb::keep_alive<1, 8>(),
            "nodes (s, 4) int32: a sample is their mean; first (s, 3): where it was on the surface; slots (s,) int32 "
            "in\n"
            "the cache of the surface, -1 for a sample that is compared with `first` alone; roots (s,) int32 of its\n"
            "curve or patch in the trees of the boundary; directions (p, 3): unit normal or tangent of each piece of\n"
            "the surface; faces (f, 4) int32, whose centres are the vertices after the nodes. Arrays are not copied.");
    m.def(
        "distances",
        [](const FitSamples &samples, const BoxTrees &moving, Indices rows, std::span<std::int32_t> known,
           std::span<double> distances, std::span<Point> vectors, std::span<Point> directions,
           std::span<SampleNodes> nodes, std::span<SampleWeights> weights) {
            fit_distances(samples, moving, rows, known, {distances, vectors, directions, nodes, weights});
        },
        "samples"_a, "moving"_a, "rows"_a, "known"_a, "distances"_a, "vectors"_a, "directions"_a, "nodes"_a,
        "weights"_a, ReleaseGil(),
        "Write of all samples, s of the boundary and then t of the surface, the distances (s + t,) from the other,\n"
        "the vectors (s + t, 3) that grow as the boundary moves along them, the unit normal or tangent there, and\n"
        "the nodes (s + t, 4) int32 that move with it with their weights (s + t, 4).\n\n"
        "moving: trees of the boundary as it is, with boxes that are up to date. rows (k,) int32: those that are\n"
        "written, each once. known (t,) int32: a piece near each sample of the surface, the first t of the boundary\n"
        "as it was, -1 for none; it is written.");
    m.def("add_gradient", &fit_gradient, "nodes"_a, "weights"_a, "vectors"_a, "gradient"_a, ReleaseGil(),
          "Add vectors (k, 3), times the weights (k, 4) of their nodes (k, 4) int32, to the rows of gradient (n, 3).");
    bind_fit_hessian<float>(m);
    bind_fit_hessian<double>(m);
}

void bind_sliding_surface(nb::module_ m) {
    m.doc() =
        "The surface on which nodes of the boundary slide: sweeps that take one project every trial point onto it.";
    nb::class_<BoundaryQuads>(m, "BoundaryQuads",
                              "Quads of the boundary at the nodes that slide. A step that flips one is rejected.\n\n"
                              "A quad is flipped if its normal points against `outward`; one that is flipped\n"
                              "already may stay so.")
        .def(ViewOf<Indices, Indices, std::span<const Quad>, Points>(), "start"_a, "corners"_a, "quads"_a, "outward"_a,
             "corners holds 4 * quad + corner of each of k sliding nodes, from start (k + 1,) on, all int32; quads\n"
             "(f, 4) int32; outward (f, 3) float64 are normals of the original surface, 0 where it has none.");
    nb::class_<SlidingSurface>(m, "SlidingSurface", "Curves and patches, with the nodes that slide on them.")
        .def(ViewOf<Indices, const ClosestPointCache *, const BoundaryQuads &>(), "slots"_a, "cache"_a, "quads"_a,
             "slots (n,) int32 numbers the nodes that slide, -1 for others; cache has the curve or patch of each.");
    nb::class_<SurfaceTerm>(m, "SurfaceTerm", "Term of the objective over the boundary quads of a sliding surface.")
        .def(
            ViewOf<std::span<const std::array<std::uint8_t, 4>>, std::span<const std::array<double, 3>>,
                   std::optional<std::span<const std::array<double, 8>>>, double, double>(),
            "counted"_a, "normals"_a, "inverse_lengths"_a.none(), "weight"_a, "delta"_a,
            "counted (f, 4) uint8 is 0 for corners of quads that count as perfect; normals (f, 3) float64 are the\n"
            "outward unit normals of the surface at the quads; inverse_lengths (f, 8) float64 those that the\n"
            "edges from each corner to the next and the previous are to have, with a target. weight is that of a quad\n"
            "relative to a hex; delta as of hexes.");
    m.def(
        "tangent_bases",
        [](std::span<const std::int64_t> number, Points flat, std::span<const std::array<double, 9>> smooth,
           Indices pieces, std::span<const Barycentric> weights, std::span<const bool> of_curve, double interior,
           ArrayView<double, 9> bases) {
            expect(smooth.size() == flat.size(), "smooth: a row for each of flat is expected");
            tangent_bases({number, flat, smooth}, pieces, weights, of_curve, interior, bases);
        },
        "number"_a, "flat"_a, "smooth"_a, "pieces"_a, "weights"_a, "of_curve"_a, "interior"_a, "bases"_a, ReleaseGil(),
        "Write orthonormal directions in which nodes may move, in columns, bases (k, 9): a node of a curve has one,\n"
        "one of a patch two, the other columns are 0.\n\n"
        "pieces (k,) int32 and weights (k, 3) describe the closest points of the nodes; of_curve (k,) bool. The\n"
        "normal or tangent is that of the piece where all weights exceed `interior`, or else interpolated between\n"
        "its corners. number (p,) int64 of each piece of the trees in flat (t, 3) and smooth (t, 9), unit vectors\n"
        "of triangles and segments, and of their three corners; numbers must exist.");
    m.def("tangent_projectors", &tangent_projectors, "bases"_a, "projectors"_a, ReleaseGil(),
          "Write the projectors B B^T (k, 9) onto directions, orthonormal or 0, in the columns of bases B (k, 9).");
    m.def("flipped_quads", &flipped_quads, "before"_a, "after"_a, "quads"_a, "outward"_a, "flipped"_a, ReleaseGil(),
          "Write flipped (f,) bool: True for a quad that is flipped at the points after and was not before.");
}

}  // namespace hexmend
