// Extension module of the scalar reference: the formulas of the kernels, one hex after another, without vectors. Tests
// and benchmarks compare the kernels with it; wheels do not contain it.
#include "bindings/arrays.hpp"
#include "energy/objective_loops.hpp"
#include "smoothers/node_step.hpp"

namespace hexmend::scalar {
namespace {

void energies(Points points, Hexes hexes, double delta, double offset, OmittedCorners omitted, std::span<double> eta,
              const TargetMatrices *target) {
    expect(have_rows(hexes.size(), omitted, eta), "omitted and eta: one for each hex is expected");
    expect_rows(target, hexes.size());
    with_target(target, [&](const auto &w) {
        using Target = std::remove_cvref_t<decltype(w)>;
        (delta != 0 ? energies_of<true, double, Target> : energies_of<false, double, Target>)(points, hexes, delta,
                                                                                              offset, omitted, eta, w);
    });
}

void gradient(Points points, Hexes hexes, double delta, ObjectiveNorm norm, OmittedCorners omitted,
              CornerVectors shares, const TargetMatrices *target) {
    expect(have_rows(hexes.size(), omitted, shares), "omitted and shares: one for each hex is expected");
    expect_rows(target, hexes.size());
    with_target(target, [&](const auto &w) {
        using Target = std::remove_cvref_t<decltype(w)>;
        (delta != 0 ? gradient_of<true, double, Target> : gradient_of<false, double, Target>)(points, hexes, delta,
                                                                                              norm, omitted, shares, w);
    });
}

void hessian_product(Points points, Hexes hexes, Hexes slots, Points values, double delta, ObjectiveNorm norm,
                     OmittedCorners omitted, CornerVectors shares, const TargetMatrices *target) {
    expect(have_rows(hexes.size(), omitted, slots, shares), "omitted, slots and shares: one for each hex is expected");
    expect_rows(target, hexes.size());
    with_target(target, [&](const auto &w) {
        using Target = std::remove_cvref_t<decltype(w)>;
        (delta != 0 ? hessian_product_of<true, double, Target>
                    : hessian_product_of<false, double, Target>)(points, hexes, slots, values, delta, norm, omitted,
                                                                 shares, w);
    });
}

std::int64_t local_sweep(std::span<Point> points, const HexMesh &mesh, Indices groups, Indices nodes,
                         const NodeStepSettings &settings) {
    expect_sweep(points, mesh, groups, nodes, settings);
    return with_target(settings.target, [&](const auto &target) {
        using Target = std::remove_cvref_t<decltype(target)>;
        return (settings.delta != 0
                    ? local_sweep_of<true, double, Target>
                    : local_sweep_of<false, double, Target>)(points, mesh, groups, nodes, settings, target);
    });
}

}  // namespace
}  // namespace hexmend::scalar

NB_MODULE(HEXMEND_MODULE, m) {
    using namespace hexmend;
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
