#include "energy/barrier.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_barrier(nb::module_ &m) {
    m.doc() = "The scalar formulas of a corner tetrahedron, as all kernels use them.";
    m.def("power_minus_two_thirds", &powers, "h"_a, "powers"_a, ReleaseGil(), "Write h^(-2/3) to powers.");
    m.def("barrier", &barriers, "sigma"_a, "delta"_a, "h"_a, "r"_a, ReleaseGil(),
          "Write h(sigma) of (3.2) and r = sqrt(sigma^2 + 4 delta^2).");
}

}  // namespace hexmend
