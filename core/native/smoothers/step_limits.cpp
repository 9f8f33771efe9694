#include "smoothers/step_limits.hpp"

#include <algorithm>

#include "mesh/csr.hpp"
#include "simd/simd_hexes.hpp"

namespace hexmend {

void shorten(std::span<Point> step, Points points, Indices ring_start, Indices ring, Indices nodes, double reach) {
    expect(step.size() == nodes.size(), "step: a row for each of nodes is expected");
    expect_rings(points.size(), ring_start, ring);
    parallel_for(nodes.size(), HEXES_PER_CHUNK, [&](std::int64_t k) {
        const Node i = nodes[k];
        double total = 0;
        for (auto s = ring_start[i]; s < ring_start[i + 1]; ++s)
            total += length(vector(points[ring[s]]) - vector(points[i]));
        double furthest = reach * total / (ring_start[i + 1] - ring_start[i]);
        double far = length(vector(step[k]));
        if (far > furthest)
            for (double &x : step[k]) x *= furthest / far;
    });
}

void displaced(Points points, Indices nodes, Points step, double alpha, std::span<Point> moved) {
    expect(step.size() == nodes.size(), "step: a row for each of nodes is expected");
    expect(moved.size() == points.size(), "moved: a row for each of points is expected");
    std::copy(points.begin(), points.end(), moved.begin());
    for (std::size_t k = 0; k < nodes.size(); ++k)
        for (int j = 0; j < 3; ++j) moved[nodes[k]][j] += alpha * step[k][j];
}

}  // namespace hexmend
