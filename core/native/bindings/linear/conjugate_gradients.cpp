#include "linear/conjugate_gradients.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {
namespace {

template <class Real> void bind_for(nb::module_ &m) {
    m.def("solve", &solve<Real>, "bounds"_a, "row_start"_a, "columns"_a, "off"_a, "diagonal"_a, "damping"_a, "right"_a,
          "tolerance"_a, "most"_a, "x"_a, "work"_a, ReleaseGil(),
          "Solve A x = right, stopping at a direction of negative curvature (Steihaug 1983).\n"
          "\n"
          "At such a direction x is the iterate so far or, if it is the first, that direction. Vectors, (k, 4) with a\n"
          "fourth number 0, are in the precision of the matrix; sums over them are in double precision.\n"
          "\n"
          "bounds, row_start, columns: pattern, as `ordering` makes it. off (blocks + 1, 9): blocks above the "
          "diagonal, and\n"
          "an unused one. diagonal (k, 6). damping: this multiple of D is added to the diagonal. tolerance: of the "
          "residual\n"
          "relative to the right-hand side, both in the norm of M^-1. most: limit of iterations. work (64 k + 16,):\n"
          "workspace. Writes x; returns the iterations, and DONE, NEGATIVE_CURVATURE or TOO_MANY.");
    m.def("product", &product<Real>, "bounds"_a, "row_start"_a, "columns"_a, "off"_a, "diagonal"_a, "order"_a, "x"_a,
          "y"_a, ReleaseGil(),
          "Product A x of x (k, 3) in double precision; writes y (k, 3).\n"
          "\n"
          "Row k of x and y belongs to slot order[k].");
}

}  // namespace

void bind_conjugate_gradients(nb::module_ &m) {
    m.doc() = "Conjugate gradients with an assembled Hessian, preconditioned by symmetric Gauss-Seidel.";
    m.attr("DONE") = static_cast<int>(DONE);
    m.attr("NEGATIVE_CURVATURE") = static_cast<int>(NEGATIVE_CURVATURE);
    m.attr("TOO_MANY") = static_cast<int>(TOO_MANY);
    bind_for<float>(m);
    bind_for<double>(m);
}

}  // namespace hexmend
