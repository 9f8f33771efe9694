#include "mesh/elements.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_elements(nb::module_ &m) {
    m.doc() = "Quality of every hex from its eight corner tetrahedra, in one pass.";
    m.def(
        "measure", &measure, "points"_a, "hexes"_a, "q"_a, "sigma"_a, "jacobian"_a, "eta"_a, ReleaseGil(),
        "Quality of every hex at delta = 0; writes four arrays (m,) float64.\n\n"
        "q is q(H), the mean of q(T) = 3 sigma^(2/3)/|S|^2, 0 where sigma <= 0: (2.8), (2.10). sigma is the least of\n"
        "the eight corner determinants, (2.9). jacobian is the least of sigma/(|e1||e2||e3|), 0 at a corner with an\n"
        "edge of no length. eta is eta(H) = mean of eta(T) - 1, (B.20); +inf where sigma <= 0. A corner whose\n"
        "determinant is larger than any float has q(T) = 0, eta(T) = +inf and a scaled Jacobian of 0.");
    m.def("mean_edge_length", &mean_edge_length, "points"_a, "hexes"_a, ReleaseGil(),
          "Mean length of the hexes' edges, each counted once a hex; 0 without hexes.");
    m.def("corner_qualities", &corner_qualities, "points"_a, "hexes"_a, "q"_a, ReleaseGil(),
          "q(T) of the eight corner tetrahedra of every hex, (2.8), 0 where sigma <= 0; writes q (m, 8) float64.");
    m.def("corner_determinants", &corner_determinants, "points"_a, "hexes"_a, "sigma"_a, ReleaseGil(),
          "sigma of the eight corner tetrahedra of every hex, (2.9); writes sigma (m, 8) float64.");
}

}  // namespace hexmend
