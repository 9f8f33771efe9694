#include "scalar_reference.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_scalar_reference(nb::module_ m) {
    m.doc() = "Scalar reference of the kernels: the same formulas without vectors, one hex after another.";
    m.def("energies", &scalar::energies, "points"_a, "hexes"_a, "delta"_a, "offset"_a, "omitted"_a, "eta"_a,
          "target"_a.none() = nb::none(), ReleaseGil(), "As `objective.energies`.");
    m.def("gradient", &scalar::gradient, "points"_a, "hexes"_a, "delta"_a, "norm"_a, "omitted"_a, "shares"_a,
          "target"_a.none() = nb::none(), ReleaseGil(), "As `objective.gradient`.");
    m.def("hessian_product", &scalar::hessian_product, "points"_a, "hexes"_a, "slots"_a, "values"_a, "delta"_a,
          "norm"_a, "omitted"_a, "shares"_a, "target"_a.none() = nb::none(), ReleaseGil(),
          "As `objective.hessian_product`.");
    m.def("sweep", &scalar::local_sweep, "points"_a, "mesh"_a, "groups"_a, "nodes"_a, "settings"_a, ReleaseGil(),
          "As `local.sweep`.");
}

}  // namespace hexmend
