#include "smoothers/step_limits.hpp"

#include <algorithm>

#include "mesh/csr.hpp"
#include "simd/simd_hexes.hpp"

namespace hexmend {

namespace {

// Shorten a step from a point that is longer than `reach` times the mean distance of its neighbours.
void shorten_step(Point &step, Points points, Node node, Indices neighbours, double reach) {
    double total = 0;
    for (Node other : neighbours) total += length(vector(points[other]) - vector(points[node]));
    double furthest = reach * total / static_cast<int>(neighbours.size());
    double far = length(vector(step));
    if (far > furthest)
        for (double &x : step) x *= furthest / far;
}

}  // namespace

void shorten(std::span<Point> step, Points points, Hexes hexes, Indices start, Indices corners, Indices nodes,
             double reach) {
    expect(step.size() == nodes.size(), "step: a row for each of nodes is expected");
    expect_corners(hexes.size(), start, corners);
    expect(start.size() == points.size() + 1, "start: one more than points is expected");
    const auto most = 3 * widest(start);
    parallel_chunks(nodes.size(), HEXES_PER_CHUNK, [&](std::int64_t begin, std::int64_t end) {
        std::vector<Node> ring(most);
        for (auto k = begin; k < end; ++k) {
            const Node i = nodes[k];
            int size = 0;  // of the ring, ascending
            for (auto s = start[i]; s < start[i + 1]; ++s) {
                const Hex &hex = hexes[corners[s] / 8];
                const auto &tetrahedron = CORNER_TETRAHEDRA[corners[s] % 8];
                for (int j = 1; j < 4; ++j)
                    if (auto other = hex[tetrahedron[j]]; other != i) placed(ring.data(), size, other);
            }
            shorten_step(step[k], points, i, {ring.data(), static_cast<std::size_t>(size)}, reach);
        }
    });
}

void shorten_by_rings(std::span<Point> step, Points points, Indices start, Indices ring, Indices nodes, double reach) {
    expect(step.size() == nodes.size(), "step: a row for each of nodes is expected");
    expect_rings(points.size(), start, ring);
    parallel_for(nodes.size(), HEXES_PER_CHUNK, [&](std::int64_t k) {
        const Node i = nodes[k];
        shorten_step(step[k], points, i, ring.subspan(start[i], start[i + 1] - start[i]), reach);
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
