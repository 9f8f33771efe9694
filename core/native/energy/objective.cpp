#include "energy/objective.hpp"

#include "energy/objective_loops.hpp"

namespace hexmend {

void energies(Points points, Hexes hexes, double delta, double offset, OmittedCorners omitted, std::span<double> eta,
              const TargetMatrices *target) {
    energies_in<Lanes>(points, hexes, delta, offset, omitted, eta, target);
}

void gradient(Points points, Hexes hexes, double delta, ObjectiveNorm norm, OmittedCorners omitted,
              CornerVectors shares, const TargetMatrices *target) {
    gradient_in<Lanes>(points, hexes, delta, norm, omitted, shares, target);
}

void hessian_product(Points points, Hexes hexes, Hexes slots, Points values, double delta, ObjectiveNorm norm,
                     OmittedCorners omitted, CornerVectors shares, const TargetMatrices *target) {
    hessian_product_in<Lanes>(points, hexes, slots, values, delta, norm, omitted, shares, target);
}

void gather(std::span<const Point> shares, Indices start, Indices corners, Indices nodes, std::span<Point> rows) {
    expect(corners.size() <= shares.size(),
           "corners: at most as many as the rows of shares, eight a cell, are expected");
    expect(are_csr(start, corners.size()), "start: its last number is expected to be the length of corners");
    expect(rows.size() == nodes.size(), "rows: one for each of nodes is expected");
    parallel_for(nodes.size(), 4 * HEXES_PER_CHUNK, [&](std::int64_t k) {
        Point sum{};
        for (auto s = start[nodes[k]]; s < start[nodes[k] + 1]; ++s)
            for (int j = 0; j < 3; ++j) sum[j] += shares[corners[s]][j];
        rows[k] = sum;
    });
}

}  // namespace hexmend
