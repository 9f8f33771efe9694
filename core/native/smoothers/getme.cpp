#include "smoothers/getme.hpp"

#include "mesh/quality.hpp"
#include "smoothers/element_step.hpp"

namespace hexmend {

void element_steps(Points points, Hexes hexes, double s, double rho, CornerVectors places) {
    expect(places.size() == hexes.size(), "places: a row for each of hexes is expected");
    for_each_corners<Lanes>(points, hexes, [&](auto cell, const Corners<Lanes> &x, std::int64_t first, int count) {
        store(element_step<decltype(cell)>(x, s, rho), first, count, places);
    });
}

void weighted_means(std::span<const std::array<double, 24>> places, Numbers weights, const HexMesh &mesh, Indices nodes,
                    std::span<Point> targets) {
    expect(have_rows(mesh.hexes.size(), places, weights), "places and weights: a row for each hex is expected");
    expect(targets.size() == mesh.nodes(), "targets: a row for each node is expected");
    parallel_for(nodes.size(), HEXES_PER_CHUNK, [&](std::int64_t k) {
        const Node i = nodes[k];
        double total = 0;
        Point sum{};
        for (auto corner : mesh.star(i)) {
            int h = corner / 8, c = corner % 8;
            total += weights[h];
            for (int j = 0; j < 3; ++j) sum[j] += weights[h] * places[h][3 * c + j];
        }
        targets[i] = {sum[0] / total, sum[1] / total, sum[2] / total};
    });
}

// Fraction of a move that remains after 0, 1, ... MAX_HALVINGS halvings: the last one gives the move up.
constexpr double STEP_FRACTIONS[] = {1, 0.5, 0.25, 0.125, 0};
constexpr int MAX_HALVINGS = 4;

std::int64_t relax(Points points, const HexMesh &mesh, std::span<const bool> valid, Indices harmed,
                   std::span<Point> moved) {
    expect_points(mesh, points);
    expect(moved.size() == points.size(), "moved: a row for each of points is expected");
    expect(valid.size() == mesh.hexes.size(), "valid: one for each hex is expected");
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
                if (hex_round[h] == round || !valid[h]) continue;
                hex_round[h] = round;
                if (!is_valid(moved, hexes[h])) queue.push_back(h);
            }
    }
    return relaxed;
}

}  // namespace hexmend
