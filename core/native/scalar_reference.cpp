// Compiled without automatic vectorisation.
#include "scalar_reference.hpp"

#include "energy/objective_loops.hpp"
#include "smoothers/node_step.hpp"

namespace hexmend {

void scalar::energies(Points points, Hexes hexes, double delta, double offset, OmittedCorners omitted,
                      std::span<double> eta) {
    (delta != 0 ? energies_of<true, double> : energies_of<false, double>)(points, hexes, delta, offset, omitted, eta);
}

void scalar::gradient(Points points, Hexes hexes, double delta, ObjectiveNorm norm, OmittedCorners omitted,
                      CornerVectors shares) {
    (delta != 0 ? gradient_of<true, double> : gradient_of<false, double>)(points, hexes, delta, norm, omitted, shares);
}

void scalar::hessian_product(Points points, Hexes hexes, Hexes slots, Points values, double delta, ObjectiveNorm norm,
                             OmittedCorners omitted, CornerVectors shares) {
    (delta != 0 ? hessian_product_of<true, double> : hessian_product_of<false, double>)(points, hexes, slots, values,
                                                                                        delta, norm, omitted, shares);
}

std::int64_t scalar::local_sweep(std::span<Point> points, const HexMesh &mesh, Indices groups, Indices nodes,
                                 const NodeStepSettings &settings) {
    return (settings.delta != 0 ? local_sweep_of<true, double> : local_sweep_of<false, double>)(points, mesh, groups,
                                                                                                nodes, settings);
}

}  // namespace hexmend
