#include "linear/eigenvalues.hpp"

#include <nanobind/stl/array.h>

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_symmetric(nb::module_ &m) {
    m.doc() = "Symmetric 3 x 3 matrices, xx xy xz yy yz zz.";
    m.def("extreme_eigenvalues", &extremes_of, "a"_a, "Least and greatest eigenvalue (Smith 1961).");
    m.def("solve", &solution_of, "a"_a, "b"_a, "Solution of the linear system; zero where the matrix is singular.");
    m.def("newton", &newton_step, "hessian"_a, "gradient"_a, "modified"_a,
          "The direction of Algorithm A.3 or, modified, A.4, at a node.");
}

}  // namespace hexmend
