#include "energy/objective.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_objective(nb::module_ &m) {
    m.doc() = "Sum of eta(H)^p over a mesh: energies, gradient, Hessian product.";
    m.def("energies", &energies, "points"_a, "hexes"_a, "delta"_a, "offset"_a, "omitted"_a, "eta"_a, ReleaseGil(),
          "eta(H), the mean of eta(T) minus offset, of every hex, with the barrier of (3.2) regularised by delta, in "
          "the\n"
          "unit of sigma; writes eta (m,).\n"
          "\n"
          "Bit t of omitted (m,) uint8 is set where corner tetrahedron t of the hex is omitted, that is, counts as "
          "perfect.");
    m.def("gradient", &gradient, "points"_a, "hexes"_a, "delta"_a, "norm"_a, "omitted"_a, "shares"_a, ReleaseGil(),
          "Gradient of sum eta(H)^p by the corners of every hex, (B.3), (B.21); writes shares (m, 8, 3).");
    m.def(
        "hessian_product", &hessian_product, "points"_a, "hexes"_a, "slots"_a, "values"_a, "delta"_a, "norm"_a,
        "omitted"_a, "shares"_a, ReleaseGil(),
        "Hessian of sum eta(H)^p times a displacement of the free nodes, (B.19) corrected; writes shares (m, 8, 3).\n\n"
        "slots is the number of each corner among the free nodes, -1 if it is fixed; values has a row for each.");
    m.def("gather", &gather, "shares"_a, "start"_a, "corners"_a, "nodes"_a, "rows"_a, ReleaseGil(),
          "Sum of the contributions, shares (m, 8, 3), over the corners at each of `nodes` (k,); writes rows (k, 3).");
}

}  // namespace hexmend
