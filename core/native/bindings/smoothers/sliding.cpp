#include "smoothers/sliding.hpp"

#include "bindings/arrays.hpp"
#include "smoothers/laplacian.hpp"
#include "smoothers/worst_first.hpp"

namespace hexmend {
namespace {

using Pieces = std::span<const Piece>;
using Boxes = std::span<const Box>;
using TreeLinks = std::span<const TreeLink>;
using Quads = std::span<const Quad>;

std::int64_t local(std::span<Point> points, Hexes hexes, Indices start, Indices corners, Indices groups, Indices nodes,
                   int direction, double delta, ObjectiveNorm power, double first, double shrink, double c1, int cuts,
                   std::span<const Tangents> tangents, Indices slots, Indices roots, Points vertices, Pieces pieces,
                   Boxes boxes, TreeLinks links, Indices quads_start, Indices quads_at, Quads quads, Points outward) {
    SlidingSurface surface{slots, roots, {vertices, pieces, boxes, links}, {quads_start, quads_at, quads, outward}};
    NodeStepSettings settings{direction, delta, power, {first, shrink, c1, cuts}};
    return sliding_sweep(points, hexes, start, corners, groups, nodes, settings, surface, tangents);
}

void laplacian(std::span<Point> points, Indices ring_start, Indices ring, Indices nodes, Indices slots, Indices roots,
               Points vertices, Pieces pieces, Boxes boxes, TreeLinks links, Indices quads_start, Indices quads_at,
               Quads quads, Points outward) {
    SlidingSurface surface{slots, roots, {vertices, pieces, boxes, links}, {quads_start, quads_at, quads, outward}};
    in_place_on(&surface, points, ring_start, ring, nodes);
}

std::int64_t smart_laplacian(std::span<Point> points, Hexes hexes, Indices start, Indices corners, Indices ring_start,
                             Indices ring, Indices nodes, bool keep_least_quality, Indices slots, Indices roots,
                             Points vertices, Pieces pieces, Boxes boxes, TreeLinks links, Indices quads_start,
                             Indices quads_at, Quads quads, Points outward) {
    SlidingSurface surface{slots, roots, {vertices, pieces, boxes, links}, {quads_start, quads_at, quads, outward}};
    return guarded_on(&surface, points, hexes, start, corners, ring_start, ring, nodes, keep_least_quality);
}

std::int64_t sequential_getme(std::span<Point> points, Hexes hexes, Indices start, Indices corners,
                              std::span<const bool> free, Indices candidates, std::span<double> q,
                              std::span<bool> sound, double s, double rho, double penalty, double setback,
                              Indices slots, Indices roots, Points vertices, Pieces pieces, Boxes boxes,
                              TreeLinks links, Indices quads_start, Indices quads_at, Quads quads, Points outward) {
    SlidingSurface surface{slots, roots, {vertices, pieces, boxes, links}, {quads_start, quads_at, quads, outward}};
    return sweep_on(&surface, points, hexes, start, corners, free, candidates, q, sound, s, rho, penalty, setback);
}

}  // namespace

void bind_sliding(nb::module_ &m) {
    m.doc() =
        "Sweeps in which nodes of the boundary slide: every trial point is projected onto the node's own curve or\n"
        "patch.\n\n"
        "slots (n,) int32 numbers the nodes that slide, -1 for others; roots (k,) int32 are the roots of their trees;\n"
        "vertices, pieces, boxes and links are those of `hexmend.kernels.closest_point`. quads (f, 4) int32 are the\n"
        "quads of the boundary, outward (f, 3) the normals of the original surface, or 0; quads_at holds\n"
        "4 * quad + corner of each node that slides, from quads_start (k + 1,) on. A step that inverts a quad against\n"
        "its normal is rejected; a quad that is inverted already may stay so.";
    m.def("local", &local, "points"_a, "hexes"_a, "start"_a, "corners"_a, "groups"_a, "nodes"_a, "direction"_a,
          "delta"_a, "power"_a, "first"_a, "shrink"_a, "c1"_a, "cuts"_a, "tangents"_a, "slots"_a, "roots"_a,
          "vertices"_a, "pieces"_a, "boxes"_a, "links"_a, "quads_start"_a, "quads_at"_a, "quads"_a, "outward"_a,
          ReleaseGil(),
          "`hexmend.kernels.local.sweep`, in which nodes that slide step along the surface: T'g and T'HT are the\n"
          "derivatives, and the line search evaluates the energy at projected points. tangents (k, 6) float64: two\n"
          "unit tangents of each sliding node, the second 0 on a curve.");
    m.def("laplacian", &laplacian, "points"_a, "ring_start"_a, "ring"_a, "nodes"_a, "slots"_a, "roots"_a, "vertices"_a,
          "pieces"_a, "boxes"_a, "links"_a, "quads_start"_a, "quads_at"_a, "quads"_a, "outward"_a, ReleaseGil(),
          "`hexmend.kernels.laplacian.in_place`, each mean projected.");
    m.def("guarded", &smart_laplacian, "points"_a, "hexes"_a, "start"_a, "corners"_a, "ring_start"_a, "ring"_a,
          "nodes"_a, "keep_least_quality"_a, "slots"_a, "roots"_a, "vertices"_a, "pieces"_a, "boxes"_a, "links"_a,
          "quads_start"_a, "quads_at"_a, "quads"_a, "outward"_a, ReleaseGil(),
          "`hexmend.kernels.laplacian.guarded`, each mean projected before the move is checked.");
    m.def("worst_first", &sequential_getme, "points"_a, "hexes"_a, "start"_a, "corners"_a, "free"_a, "candidates"_a,
          "q"_a, "sound"_a, "s"_a, "rho"_a, "penalty"_a, "setback"_a, "slots"_a, "roots"_a, "vertices"_a, "pieces"_a,
          "boxes"_a, "links"_a, "quads_start"_a, "quads_at"_a, "quads"_a, "outward"_a, ReleaseGil(),
          "`hexmend.kernels.worst_first.sweep`, each element step projected before it is checked.");
    m.def("turned", &newly_inverted, "before"_a, "after"_a, "quads"_a, "outward"_a, "is"_a, ReleaseGil(),
          "Write is (f,) bool: True for a quad that is inverted at the points after and was not before.");
}

}  // namespace hexmend
