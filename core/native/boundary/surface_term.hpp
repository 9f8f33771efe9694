// The weight of a boundary's quads in the objective, with what their energy needs; see energy/node_quads.hpp.
#pragma once

#include <optional>

#include "mesh/array_views.hpp"

namespace hexmend {

struct SurfaceTerm {
    std::span<const std::array<std::uint8_t, 4>> counted;  // 0 for a corner that counts as perfect
    std::span<const std::array<double, 3>> normals;        // of the surface at each quad
    // Of the edges to the next and the previous corner, by corner, in the points' unit; with a target.
    std::optional<std::span<const std::array<double, 8>>> inverse_lengths;
    double weight;  // of a quad relative to a hex
    double delta;   // in mean edge lengths of the node's patch

    void check() const {
        expect(normals.size() == counted.size(), "normals: a row for each quad is expected");
        expect(!inverse_lengths || inverse_lengths->size() == counted.size(),
               "inverse_lengths: a row for each quad is expected");
    }
};

}  // namespace hexmend
