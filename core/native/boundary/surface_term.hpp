// The weight of a boundary's quads in the objective, with what their energy needs; see energy/node_quads.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace hexmend {

struct SurfaceTerm {
    std::span<const std::array<std::uint8_t, 4>> counted;    // 0 for a corner that counts as perfect
    std::span<const std::array<double, 3>> normals;          // of the surface at each quad
    std::span<const std::array<double, 8>> inverse_lengths;  // of the edges to the next and the previous corner, by
                                                             // corner, in the points' unit; empty without a target
    double weight;                                           // of a quad relative to a hex
    double delta;                                            // in mean edge lengths of the node's patch
};

}  // namespace hexmend
