#include "linear/conjugate_gradients.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {
namespace {

template <class Real> void bind_for(nb::module_ &m) {
    m.def("solve", &solve<Real>, "pattern"_a, "off_diagonal"_a, "diagonal"_a, "damping"_a, "rhs"_a, "tolerance"_a,
          "max_iterations"_a, "x"_a, "work"_a, ReleaseGil(),
          "Solve A x = rhs, stopping at a direction of negative curvature (Steihaug 1983).\n"
          "\n"
          "At such a direction x is the iterate so far or, if it is the first, that direction. Vectors, (k, 4) with a\n"
          "fourth number 0, are in the precision of the matrix; sums over them are in double precision.\n"
          "\n"
          "off_diagonal (blocks + 1, 9): blocks above the diagonal, and an unused one. diagonal (k, 6). damping: this\n"
          "multiple of D is added to the diagonal. tolerance: of the residual relative to the right-hand side, both in "
          "the\n"
          "norm of M^-1. work (64 k + 16,):\n"
          "workspace. Writes x; returns the iterations, and DONE, NEGATIVE_CURVATURE or TOO_MANY.");
    m.def("product", &product<Real>, "pattern"_a, "off_diagonal"_a, "diagonal"_a, "order"_a, "x"_a, "y"_a, ReleaseGil(),
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
    nb::class_<BlockPattern>(m, "BlockPattern", "Pattern of a symmetric matrix of 3 x 3 blocks.")
        .def(
            "__init__",
            [](BlockPattern *self, Indices bounds, Indices row_start, Indices columns) {
                expect(!bounds.empty() && bounds.back() + 1 == static_cast<std::int64_t>(row_start.size()),
                       "row_start: one more than the last of bounds is expected");
                expect(row_start.back() == static_cast<std::int64_t>(columns.size()),
                       "columns: as many as the last of row_start are expected");
                new (self) BlockPattern{bounds, row_start, columns};
            },
            "bounds"_a, "row_start"_a, "columns"_a, nb::keep_alive<1, 2>(), nb::keep_alive<1, 3>(),
            nb::keep_alive<1, 4>(),
            "bounds (2 parts,) int32: `ordering.slots`; row_start (k + 1,) and columns (blocks,) int32: blocks above "
            "the\n"
            "diagonal, `sparsity.pattern`. Arrays are not copied.");
    bind_for<float>(m);
    bind_for<double>(m);
}

}  // namespace hexmend
