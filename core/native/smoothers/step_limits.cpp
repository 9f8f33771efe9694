#include "smoothers/step_limits.hpp"

#include <algorithm>
#include <vector>

#include "simd/simd_hexes.hpp"

namespace hexmend {

void shorten(std::span<Point> step, Points points, const HexMesh &mesh, Indices nodes, double reach) {
    expect(step.size() == nodes.size(), "step: a row for each of nodes is expected");
    expect_points(mesh, points);
    const int most = 3 * mesh.largest_star();
    parallel_chunks(nodes.size(), HEXES_PER_CHUNK, [&](std::int64_t begin, std::int64_t end) {
        std::vector<Node> ring(most);
        for (auto k = begin; k < end; ++k) {
            const int size = mesh.ring(nodes[k], ring.data());
            double total = 0;
            for (int s = 0; s < size; ++s) total += length(vector(points[ring[s]]) - vector(points[nodes[k]]));
            double furthest = reach * total / size;
            double far = length(vector(step[k]));
            if (far > furthest)
                for (double &x : step[k]) x *= furthest / far;
        }
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
