#include "scalar_reference.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_scalar_reference(nb::module_ &m) {
    m.doc() = "What kernels are measured against and compared with: the same formulas, one hex after another.";
    m.def("energies", &plain::energies, "points"_a, "hexes"_a, "delta"_a, "offset"_a, "left_out"_a, "eta"_a,
          ReleaseGil(), "As `objective.energies`.");
    m.def("gradient", &plain::gradient, "points"_a, "hexes"_a, "delta"_a, "power"_a, "left_out"_a, "shares"_a,
          ReleaseGil(), "As `objective.gradient`.");
    m.def("hessian_product", &plain::hessian_product, "points"_a, "hexes"_a, "slots"_a, "values"_a, "delta"_a,
          "power"_a, "left_out"_a, "shares"_a, ReleaseGil(), "As `objective.hessian_product`.");
    m.def("sweep", &plain::sweep, "points"_a, "hexes"_a, "start"_a, "corners"_a, "groups"_a, "nodes"_a, "direction"_a,
          "delta"_a, "power"_a, "first"_a, "shrink"_a, "c1"_a, "cuts"_a, ReleaseGil(), "As `local.sweep`.");
}

}  // namespace hexmend
