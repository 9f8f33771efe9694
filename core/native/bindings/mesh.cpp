#include "bindings/arrays.hpp"
#include "mesh/csr.hpp"
#include "mesh/hex_mesh.hpp"
#include "mesh/incidence.hpp"
#include "mesh/metrics.hpp"
#include "mesh/refinement.hpp"
#include "mesh/validity.hpp"

namespace hexmend {

void bind_elements(nb::module_ m) {
    m.doc() = "Quality of every hex from its eight corner tetrahedra, in one pass.";
    m.def("measure", &measure, "points"_a, "hexes"_a, "q"_a, "sigma"_a, "jacobian"_a, "eta"_a, ReleaseGil(),
          "Quality of every hex at delta = 0; writes four arrays (m,) float64.\n\n"
          "q is q(H), the mean of q(T) = 3 sigma^(2/3)/|S|^2, 0 where sigma <= 0: (2.8), (2.10). sigma is the least\n"
          "of the eight corner determinants, (2.9). jacobian is the least of sigma/(|e1||e2||e3|), 0 at a corner\n"
          "with an edge of no length. eta is eta(H) = mean of eta(T) - 1, (B.20); +inf where sigma <= 0. A corner\n"
          "whose determinant is larger than any float has q(T) = 0, eta(T) = +inf and a scaled Jacobian of 0.");
    m.def("measure_against", &measure_against, "points"_a, "hexes"_a, "target"_a, "q"_a, "eta"_a, ReleaseGil(),
          "Quality of every hex against its target at delta = 0; writes two arrays (m,) float64.\n\n"
          "eta is eta(H) of S W^-1, the mean of eta(T) - 1, and of the size if it has a weight; q is\n"
          "the mean of 1/eta(T). An inverted corner has eta(T) = +inf.");
    m.def("mean_edge_length", &mean_edge_length, "points"_a, "hexes"_a, ReleaseGil(),
          "Mean length of the hexes' edges, each counted once a hex; 0 without hexes.");
    m.def("lower_to_edges", &lower_to_edges, "points"_a, "hexes"_a, "lengths"_a, ReleaseGil(),
          "Lower lengths (n,), at the nodes of hexes, to that of the shortest edge of theirs at each. Runs on one\n"
          "thread.");
    m.def("corner_qualities", &corner_qualities, "points"_a, "hexes"_a, "q"_a, ReleaseGil(),
          "q(T) of the eight corner tetrahedra of every hex, (2.8), 0 where sigma <= 0; writes q (m, 8) float64.");
    m.def("corner_determinants", &corner_determinants, "points"_a, "hexes"_a, "sigma"_a, ReleaseGil(),
          "sigma of the eight corner tetrahedra of every hex, (2.9); writes sigma (m, 8) float64.");
    m.def("corner_jacobians", &corner_jacobians, "points"_a, "hexes"_a, "jacobians"_a, ReleaseGil(),
          "Scaled Jacobians of the eight corner tetrahedra of every hex, sigma/(|e1||e2||e3|), -1 where an edge has\n"
          "no length; writes jacobians (m, 8) float64.");
}

void bind_faces(nb::module_ m) {
    m.doc() = "Metrics of every hex from its six faces. Each function writes arrays (m,) float64.";
    m.def("angles", &angles, "points"_a, "hexes"_a, "smallest"_a, "largest"_a, ReleaseGil(),
          "Angles between adjacent edges of the faces, four corners of six faces, in degrees; 0 and 180 where an\n"
          "edge has no length.");
    m.def("warpage", &warpage, "points"_a, "hexes"_a, "worst"_a, ReleaseGil(),
          "Greatest over the faces of 1 - min((n0 . n2)^3, (n1 . n3)^3), n the unit normals at the face's corners;\n"
          "2 where a corner of a face has no normal.");
    m.def("volume", &volume, "points"_a, "hexes"_a, "enclosed"_a, ReleaseGil(),
          "Volume inside the six bilinear faces, that of Verdict's 24 tetrahedra: negative for a hex turned inside\n"
          "out.\n\n"
          "Of a face a, b, c, d it is (a + b + c + d) . (c - a) x (d - b) / 24, in the cube of the mesh's unit of\n"
          "length.");
}

void bind_validity(nb::module_ m) {
    m.doc() =
        "Validity of hexes: bounds of det J, the determinant of the map from the unit cube, everywhere in them.\n\n"
        "Second-order hexes are given by their 27 nodes each, x slowest and z fastest: nodes (m, 81) float64.";
    m.def(
        "certify", &certify, "points"_a, "hexes"_a, "validity"_a, ReleaseGil(),
        "Write the validity (m,) uint8 of hexes: 0 where det J is positive everywhere, 1 where it is not at a corner,\n"
        "2 where it is not elsewhere, 3 where that is undecided: within rounding of 0.");
    m.def("certify_quadratic", &certify_quadratic, "nodes"_a, "validity"_a, ReleaseGil(),
          "The same of second-order hexes.");
    m.def("jacobian_bounds", &jacobian_bounds, "points"_a, "hexes"_a, "bounds"_a, ReleaseGil(),
          "Write a lower bound of the least det J of each hex, and an upper bound of the greatest, (m, 2) float64.\n\n"
          "They differ from the extremes by at most a hundredth of these, or 1e-7 of the greatest coefficient.");
    m.def("jacobian_bounds_quadratic", &jacobian_bounds_quadratic, "nodes"_a, "bounds"_a, ReleaseGil(),
          "The same of second-order hexes.");
    m.def("least_jacobian", &least_jacobian, "points"_a, "hexes"_a, ReleaseGil(),
          "A lower bound, from -1 to 1, of the least det J over the greatest of the same hex, of all hexes.");
    m.def("least_jacobian_quadratic", &least_jacobian_quadratic, "nodes"_a, ReleaseGil(),
          "The same of second-order hexes.");
    m.def("jacobian_coefficients", &jacobian_coefficients, "points"_a, "hexes"_a, "coefficients"_a, ReleaseGil(),
          "Write the Bernstein coefficients of det J of each hex, (m, 27) float64, x slowest and z fastest.");
}

void bind_hex_mesh(nb::module_ m) {
    m.doc() = "Connectivity of a mesh, as sweeps take it.";
    nb::class_<HexMesh>(m, "HexMesh", "Hexes, and the corners of hexes at each node.")
        .def(ViewOf<Hexes, Indices, Indices>(), "hexes"_a, "start"_a, "corners"_a,
             "hexes (m, 8) int32; start (n + 1,) and corners (8 m,) int32: `incidence.node_corners`.");
}

void bind_incidence(nb::module_ m) {
    m.doc() = "Incidence of nodes, hexes, faces and edges; components and colours. All linear in the number of hexes.";
    m.def("node_corners", &node_corners, "hexes"_a, "n"_a, ReleaseGil(),
          "Corners of hexes at each of n nodes, as compressed rows (start (n + 1,), corners (8 m,)), both int32.\n\n"
          "Row i is corners[start[i]:start[i + 1]]: numbers 8 * hex + corner, ascending.");
    m.def("face_neighbours", &face_neighbours, "hexes"_a, "start"_a, "corners"_a, "opposed"_a = true, ReleaseGil(),
          "The hex behind each face, (m, 6) int32, and the number of non-manifold faces; start, corners:\n"
          "`node_corners`.\n\n"
          "Two faces are one if they have the same nodes in opposite order and no third face has these nodes; -1\n"
          "elsewhere. Faces that lie on the nodes of others otherwise are non-manifold, a defect of the mesh, and are\n"
          "counted once per hex. Without `opposed` any order of the nodes counts.");
    m.def("overlapping_corners", &overlapping_corners, "hexes"_a, "start"_a, "corners"_a, ReleaseGil(),
          "Corners at each node whose cones overlap wherever the nodes are, as compressed rows (start (n + 1,),\n"
          "corners), both int32; start, corners: `node_corners`.\n\n"
          "Two faces at the node have the same two edges there, in one order as seen from their hexes.");
    m.def(
        "join",
        [](std::span<std::int32_t> parent, Indices items, int width) {
            expect(width > 0 && items.size() % width == 0, "items: rows of `width` are expected");
            join(parent, items, width);
        },
        "parent"_a, "items"_a, "width"_a, ReleaseGil(),
        "Connect the items of each row of `width` items; changes parent (n,) int32, at first 0 to n - 1.\n\n"
        "Union-find: parent[i] is an item of i's component, at most i.");
    m.def("node_rings", &node_rings, "hexes"_a, "start"_a, "corners"_a, "max_items"_a = MOST_ITEMS, ReleaseGil(),
          "Edge neighbours of each node, ascending, as compressed rows (ring_start (n + 1,), ring), both int32.\n\n"
          "OverflowError where the rows have more than `max_items` items.");
    m.def("greedy_colours", &greedy_colours, "start"_a, "corners"_a, "chosen"_a, ReleaseGil(),
          "Colour the chosen nodes (n,) bool so that two of one hex never share a colour, greedily in node order.\n\n"
          "Returns (n,) int32, -1 for nodes that were not chosen.");
    m.def("grouped", &grouped, "colour"_a, "count"_a, ReleaseGil(),
          "Nodes grouped by colour, each group in node order: (start (count + 1,), nodes), both int32.");
}

void bind_metrics(nb::module_ m) {
    m.doc() =
        "Metrics of every hex from its edges, diagonals, principal axes and corners, as the Verdict library\n"
        "defines them: SAND2007-1751. Each function writes arrays (m,) float64.";
    m.def("lengths", &lengths, "points"_a, "hexes"_a, "edge_ratio"_a, "stretch"_a, "diagonal"_a, ReleaseGil(),
          "Ratios of edges and diagonals; E the twelve edges' lengths, D the four diagonals'.\n\n"
          "edge_ratio is max E / min E; +inf where an edge has no length. stretch is sqrt(3) min E / max D; 0\n"
          "where neither edge nor diagonal has a length, +inf where only diagonals have none. diagonal is min D /\n"
          "max D; 0 where no diagonal has a length.");
    m.def("axes", &axes, "points"_a, "hexes"_a, "aspect_ratio"_a, "skew"_a, "taper"_a, ReleaseGil(),
          "Figures of the principal axes X1, X2, X3, the sums of the four edges along x, y and z.\n\n"
          "aspect_ratio is max |Xi| / min |Xi|, Verdict's \"maximum edge ratio\". skew is the greatest |cos| of\n"
          "the angle of two axes. taper is the greatest |Xij| / min(|Xi|, |Xj|), Xij the cross derivatives. Where\n"
          "an axis has no length they are +inf, 1 and +inf.");
    m.def("corners", &corners, "points"_a, "hexes"_a, "shape"_a, "condition"_a, ReleaseGil(),
          "Figures of the eight corner tetrahedra, with edges S = [e1, e2, e3] and sigma = det S.\n\n"
          "shape is the least 3 sigma^(2/3) / |S|^2; 0 where sigma <= 0. condition is the greatest |S| |S^-1| / 3,\n"
          "Frobenius norms; +inf where sigma <= 0.");
    m.def("centre", &centre, "points"_a, "hexes"_a, "jacobian"_a, ReleaseGil(),
          "Determinant of the Jacobian at the centre, det [X1, X2, X3] / 64 of the principal axes.");
}

void bind_structure(nb::module_ m) {
    m.doc() = "Valence of edges, from which the block structure of a mesh follows, and averages along dual sheets.";
    m.def("edges", &edges, "hexes"_a, "start"_a, "corners"_a, "neighbours"_a, "max_items"_a = MOST_ITEMS, ReleaseGil(),
          "Every edge once, with the number of hexes around it: (ends (e, 2) int32, valence (e,) int32, outside\n"
          "(e,) bool).\n\n"
          "ends: the lower node first, ascending. valence: hexes that have the edge; one that has it twice, its\n"
          "nodes being one, counts once. outside: True for an edge of a boundary face. start, corners and\n"
          "neighbours are those of `incidence`. OverflowError where there are more than `max_items` edges.");
    m.def("average_along_sheets", &average_along_sheets, "groups"_a, "values"_a, "average"_a, "count"_a, ReleaseGil(),
          "Average values of edges (e + 1,) over the groups (g, 4) int32 of parallel edges around each edge; writes\n"
          "average (e + 1,) float64 and count (e + 1,) int32, the number of groups.\n\n"
          "It is the mean of the groups' means, and 0 without a group. The number e, and the last value, stand for\n"
          "no edge.");
    m.def("coarse_blocks", &coarse_blocks, "hexes"_a, "start"_a, "corners"_a, ReleaseGil(),
          "Nodes of each hex of the mesh of which this is a uniform refinement, 2 x 2 x 2 hexes for each, (k, 27)\n"
          "int32; no row where it is not. start, corners: `incidence.node_corners`.\n\n"
          "Node (x, y, z) of the 3 x 3 x 3 nodes of a coarse hex is in column 9 z + 3 y + x. Its axes are those of\n"
          "the first of its hexes, and coarse hexes are in the order of these.");
    m.def("interpolate_blocks", &interpolate_blocks, "blocks"_a, "kept"_a, "values"_a, ReleaseGil(),
          "Interpolate values (n, 3) float64 within the blocks (k, 27) int32 of `coarse_blocks`, from those of the\n"
          "corners and of nodes that are kept (n,) bool to all others, which it writes.\n\n"
          "The interpolation is transfinite: linear on edges, from edges and corners on faces, and from faces, edges\n"
          "and corners inside. Runs on one thread.");
}

}  // namespace hexmend
