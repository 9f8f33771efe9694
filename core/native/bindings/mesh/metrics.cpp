#include "mesh/metrics.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_metrics(nb::module_ &m) {
    m.doc() =
        "Metrics of every hex from its edges, diagonals, principal axes and corners, as the Verdict library defines "
        "them:\n"
        "SAND2007-1751. Each function writes arrays (m,) float64.";
    m.def("lengths", &lengths, "points"_a, "hexes"_a, "edge_ratio"_a, "stretch"_a, "diagonal"_a, ReleaseGil(),
          "Ratios of edges and diagonals; E the twelve edges' lengths, D the four diagonals'.\n\n"
          "edge_ratio is max E / min E; +inf where an edge has no length. stretch is sqrt(3) min E / max D; 0 where\n"
          "neither edge nor diagonal has a length, +inf where only diagonals have none. diagonal is min D / max D; 0\n"
          "where no diagonal has a length.");
    m.def("axes", &axes, "points"_a, "hexes"_a, "aspect_ratio"_a, "skew"_a, "taper"_a, ReleaseGil(),
          "Figures of the principal axes X1, X2, X3, the sums of the four edges along x, y and z.\n\n"
          "aspect_ratio is max |Xi| / min |Xi|, Verdict's \"maximum edge ratio\". skew is the greatest |cos| of the\n"
          "angle of two axes. taper is the greatest |Xij| / min(|Xi|, |Xj|), Xij the cross derivatives. Where an axis\n"
          "has no length they are +inf, 1 and +inf.");
    m.def("corners", &corners, "points"_a, "hexes"_a, "shape"_a, "condition"_a, ReleaseGil(),
          "Figures of the eight corner tetrahedra, with edges S = [e1, e2, e3] and sigma = det S.\n\n"
          "shape is the least 3 sigma^(2/3) / |S|^2; 0 where sigma <= 0. condition is the greatest |S| |S^-1| / 3,\n"
          "Frobenius norms; +inf where sigma <= 0.");
    m.def("centre", &centre, "points"_a, "hexes"_a, "jacobian"_a, ReleaseGil(),
          "Determinant of the Jacobian at the centre, det [X1, X2, X3] / 64 of the principal axes.");
}

}  // namespace hexmend
