// Extension module of the scalar reference: the formulas of the kernels, one hex after another, without vectors. Tests
// and benchmarks compare the kernels with it; wheels do not contain it.
#include "bindings/arrays.hpp"
#include "energy/objective_loops.hpp"
#include "smoothers/node_step.hpp"

NB_MODULE(HEXMEND_MODULE, m) {
    using namespace hexmend;
    m.def("energies", &energies_in<double>, "points"_a, "hexes"_a, "delta"_a, "offset"_a, "omitted"_a, "eta"_a,
          "target"_a.none() = nb::none(), ReleaseGil(), "As `objective.energies`.");
    m.def("gradient", &gradient_in<double>, "points"_a, "hexes"_a, "delta"_a, "norm"_a, "omitted"_a, "shares"_a,
          "target"_a.none() = nb::none(), ReleaseGil(), "As `objective.gradient`.");
    m.def("hessian_product", &hessian_product_in<double>, "points"_a, "hexes"_a, "slots"_a, "values"_a, "delta"_a,
          "norm"_a, "omitted"_a, "shares"_a, "target"_a.none() = nb::none(), ReleaseGil(),
          "As `objective.hessian_product`.");
    m.def("sweep", &local_sweep_in<double>, "points"_a, "mesh"_a, "groups"_a, "nodes"_a, "settings"_a, ReleaseGil(),
          "As `local.sweep`.");
}
