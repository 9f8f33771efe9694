// A Newton step of a group of nodes with the rest fixed: a sweep over patches that hold several free nodes.
#pragma once

#include <tuple>

#include "energy/objective_norm.hpp"
#include "mesh/incidence.hpp"

namespace hexmend {

std::tuple<OwnedArray<std::int32_t>, OwnedArray<std::int32_t>, OwnedArray<std::int32_t>, OwnedArray<std::int32_t>,
           OwnedArray<std::int32_t, 8>>
grow(Hexes hexes, Indices start, Indices corners, std::span<const bool> free, std::int64_t size, int overlap);

CSR colours(Indices hex_start, Indices chosen, std::int64_t hexes);

// What a method does with a patch; lengths are in mean edge lengths of the patch.
struct PatchStep {
    double delta;
    ObjectiveNorm power;
    double first, shrink, c1;
    int cuts;
};

std::pair<std::int64_t, std::int64_t> sweep(std::span<Point> points, Hexes hexes, Hexes slots, Indices hex_start,
                                            Indices node_start, Indices nodes, Indices groups, Indices patches,
                                            double delta, ObjectiveNorm power, double first, double shrink, double c1,
                                            int cuts);

}  // namespace hexmend
