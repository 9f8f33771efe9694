#include "smoothers/getme.hpp"

#include "mesh/quality.hpp"

namespace hexmend {

void weighted_means(std::span<const std::array<double, 24>> places, Numbers weights, const HexMesh &mesh, Indices nodes,
                    std::span<Point> targets) {
    parallel_chunks(nodes.size(), HEXES_PER_CHUNK, [&](std::int64_t begin, std::int64_t end) {
        for (Node i : nodes.subspan(begin, end - begin)) {
            double total = 0;
            Point sum{};
            for (auto corner : mesh.star(i)) {
                int h = corner / 8, c = corner % 8;
                total += weights[h];
                for (int k = 0; k < 3; ++k) sum[k] += weights[h] * places[h][3 * c + k];
            }
            targets[i] = {sum[0] / total, sum[1] / total, sum[2] / total};
        }
    });
}

// Fraction of a move that remains after 0, 1, ... MAX_HALVINGS halvings: the last one gives the move up.
constexpr double STEP_FRACTIONS[] = {1, 0.5, 0.25, 0.125, 0};
constexpr int MAX_HALVINGS = 4;

std::int64_t relax(Points points, const HexMesh &mesh, std::span<const bool> sound, Indices harmed,
                   std::span<Point> moved) {
    const Hexes hexes = mesh.hexes;
    std::vector<std::uint8_t> level(points.size());
    std::vector<std::int32_t> node_round(points.size()), hex_round(hexes.size());
    std::vector<Point> step(moved.begin(), moved.end());
    std::vector<std::int32_t> queue(harmed.begin(), harmed.end()), changed;
    std::int64_t relaxed = 0;
    for (int round = 1; !queue.empty(); ++round) {
        changed.clear();
        for (auto h : queue)
            for (Node i : hexes[h]) {
                if (node_round[i] == round || level[i] == MAX_HALVINGS) continue;
                node_round[i] = round;
                relaxed += level[i] == 0;
                double share = STEP_FRACTIONS[++level[i]];
                for (int k = 0; k < 3; ++k) moved[i][k] = points[i][k] + share * (step[i][k] - points[i][k]);
                changed.push_back(i);
            }
        queue.clear();
        for (Node i : changed)
            for (auto corner : mesh.star(i)) {
                int h = corner / 8;
                if (hex_round[h] == round || !sound[h]) continue;
                hex_round[h] = round;
                if (!SingleHex(moved, hexes[h]).sound()) queue.push_back(h);
            }
    }
    return relaxed;
}

}  // namespace hexmend
