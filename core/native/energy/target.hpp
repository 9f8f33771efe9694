// Targets of the hexes of a mesh: with W = diag(lengths) along a hex's own directions (x, y and z of its numbering),
// the energy is that of S W^-1 (Knupp).
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

// The targets, by the inverse of their lengths.
struct TargetMatrices {
    Points inverse_lengths;  // (m, 3)
    double size_weight = 0;  // of the size term
};

// No target: every hex is to be a cube.
struct Cubes {};

// Call body(target) with the target, or with `Cubes` where there is none.
template <class Body> inline auto with_target(const TargetMatrices *target, const Body &body) {
    return target ? body(*target) : body(Cubes{});
}

// Likewise body(soft, target), where soft is std::true_type for delta > 0.
template <class Body> inline auto with_cases(const TargetMatrices *target, double delta, const Body &body) {
    return with_target(
        target, [&](const auto &w) { return delta != 0 ? body(std::true_type{}, w) : body(std::false_type{}, w); });
}

// Throw unless there is no target or it is one of `hexes` hexes.
inline void expect_rows(const TargetMatrices *target, std::size_t hexes) {
    expect(!target || target->inverse_lengths.size() == hexes, "target: one row for each hex is expected");
}

}  // namespace hexmend
