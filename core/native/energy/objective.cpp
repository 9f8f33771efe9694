#include "energy/objective.hpp"

#include "energy/objective_loops.hpp"

namespace hexmend {

void energies(Points points, Hexes hexes, double delta, double offset, OmittedCorners omitted, std::span<double> eta,
              const TargetMatrices *target) {
    expect(omitted.size() == hexes.size() && eta.size() == hexes.size(),
           "omitted and eta: one for each hex is expected");
    expect_rows(target, hexes.size());
    with_target(target, [&](const auto &w) {
        using Target = std::remove_cvref_t<decltype(w)>;
        (delta != 0 ? energies_of<true, Lanes, Target> : energies_of<false, Lanes, Target>)(points, hexes, delta,
                                                                                            offset, omitted, eta, w);
    });
}

void gradient(Points points, Hexes hexes, double delta, ObjectiveNorm norm, OmittedCorners omitted,
              CornerVectors shares, const TargetMatrices *target) {
    expect(omitted.size() == hexes.size() && shares.size() == hexes.size(),
           "omitted and shares: one for each hex is expected");
    expect_rows(target, hexes.size());
    with_target(target, [&](const auto &w) {
        using Target = std::remove_cvref_t<decltype(w)>;
        (delta != 0 ? gradient_of<true, Lanes, Target> : gradient_of<false, Lanes, Target>)(points, hexes, delta, norm,
                                                                                            omitted, shares, w);
    });
}

void hessian_product(Points points, Hexes hexes, Hexes slots, Points values, double delta, ObjectiveNorm norm,
                     OmittedCorners omitted, CornerVectors shares, const TargetMatrices *target) {
    expect(omitted.size() == hexes.size() && slots.size() == hexes.size() && shares.size() == hexes.size(),
           "omitted, slots and shares: one for each hex is expected");
    expect_rows(target, hexes.size());
    with_target(target, [&](const auto &w) {
        using Target = std::remove_cvref_t<decltype(w)>;
        (delta != 0
             ? hessian_product_of<true, Lanes, Target>
             : hessian_product_of<false, Lanes, Target>)(points, hexes, slots, values, delta, norm, omitted, shares, w);
    });
}

void gather(std::span<const Point> shares, Indices start, Indices corners, Indices nodes, std::span<Point> rows) {
    expect(corners.size() == shares.size(), "corners: as many as the rows of shares, eight for each hex, are expected");
    expect(are_csr(start, corners.size()), "start: its last number is expected to be the length of corners");
    expect(rows.size() == nodes.size(), "rows: one for each of nodes is expected");
    parallel_chunks(nodes.size(), 4 * HEXES_PER_CHUNK, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t k = begin; k < end; ++k) {
            Point sum{};
            for (auto s = start[nodes[k]]; s < start[nodes[k] + 1]; ++s)
                for (int j = 0; j < 3; ++j) sum[j] += shares[corners[s]][j];
            rows[k] = sum;
        }
    });
}

}  // namespace hexmend
