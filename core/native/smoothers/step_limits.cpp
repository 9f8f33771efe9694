#include "smoothers/step_limits.hpp"

#include <algorithm>

#include "mesh/csr.hpp"
#include "simd/simd_hexes.hpp"

namespace hexmend {

void shorten(std::span<Point> step, Points points, Hexes hexes, Indices start, Indices corners, Indices nodes,
             double reach) {
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
            double total = 0;
            for (int s = 0; s < size; ++s) total += length(vector(points[ring[s]]) - vector(points[i]));
            double furthest = reach * total / size;
            double far = length(vector(step[k]));
            if (far > furthest)
                for (double &x : step[k]) x *= furthest / far;
        }
    });
}

void displaced(Points points, Indices nodes, Points step, double alpha, std::span<Point> moved) {
    std::copy(points.begin(), points.end(), moved.begin());
    for (std::size_t k = 0; k < nodes.size(); ++k)
        for (int j = 0; j < 3; ++j) moved[nodes[k]][j] += alpha * step[k][j];
}

}  // namespace hexmend
