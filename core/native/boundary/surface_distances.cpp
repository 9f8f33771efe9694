#include "boundary/surface_distances.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "simd/threads.hpp"

namespace hexmend {
namespace {

constexpr std::int64_t SAMPLES_PER_CHUNK = 128;

double norm(const V3<double> &a) { return std::sqrt(numpy_dot(a, a)); }

bool has_moved(Points points, Points start, const FaceNodes &nodes, const FaceWeights &weights) {
    V3<double> moved;
    for (int k = 0; k < 4; ++k) moved += weights[k] * (vector(points[nodes[k]]) - vector(start[nodes[k]]));
    return !(norm(moved) <= 0);
}

// Weights of the nodes of a face at a point of its triangle (a, b, centre).
FaceWeights weights_at(const FaceNodes &nodes, const Piece &piece, const Barycentric &weights) {
    FaceWeights found;
    for (int k = 0; k < 4; ++k) {
        found[k] = weights[2] / 4;
        for (int end = 0; end < 2; ++end) found[k] += nodes[k] == piece[end] ? weights[end] : 0;
    }
    return found;
}

}  // namespace

void find_distances(const MovingTrees &trees, Points start, std::span<const FaceNodes> faces,
                    const SurfaceSamples &samples, std::span<const std::int64_t> which, const SampleDistances &now) {
    expect(have_rows(samples.x.size(), now.distances, now.directions, now.nodes, now.weights),
           "distances, directions, nodes and weights: a row for each of samples is expected");
    expect_boxes(trees.boxes, trees.links.size());
    expect(trees.points.size() == start.size() + faces.size(), "points: the nodes and a centre a face are expected");
    expect_known(samples.pieces, trees.pieces.size());
    expect_roots(samples.roots, trees.links.size());
    std::vector<std::int64_t> searched;
    for (std::int64_t i : which) {
        if (samples.distances[i] > 0 || has_moved(trees.points, start, samples.nodes[i], samples.weights[i])) {
            searched.push_back(i);
            continue;
        }
        now.distances[i] = samples.distances[i], now.directions[i] = {};
        now.nodes[i] = samples.nodes[i], now.weights[i] = samples.weights[i];
    }
    if (searched.empty()) return;
    refit(trees.points, trees.pieces, trees.links, trees.boxes);
    const BoxTrees fitted{trees.points, trees.pieces, trees.boxes, trees.links};
    const auto first_centre = static_cast<Node>(start.size());
    parallel_for(searched.size(), SAMPLES_PER_CHUNK, [&](std::int64_t k) {
        const std::int64_t i = searched[k];
        const ClosestPoint found = fitted.closest(samples.x[i], samples.roots[i], 0, samples.pieces[i]);
        if (found.piece < 0) {
            now.distances[i] = INF;
            return;
        }
        const V3<double> away = vector(samples.x[i]) - vector(found.place);
        const double far = norm(away), over = std::max(far, std::numeric_limits<double>::min());
        const Piece &piece = trees.pieces[found.piece];
        now.distances[i] = far, now.directions[i] = {away.x / over, away.y / over, away.z / over};
        now.nodes[i] = faces[piece[2] - first_centre];
        now.weights[i] = weights_at(now.nodes[i], piece, found.weights);
    });
}

}  // namespace hexmend
