#include "boundary/near_points.hpp"

#include <cmath>
#include <vector>

#include "boundary/four_pieces.hpp"
#include "simd/threads.hpp"

namespace hexmend {
namespace {

constexpr std::int64_t SAMPLES_PER_CHUNK = 1024, SEARCHES_PER_CHUNK = 256, MARKS_PER_CHUNK = 8192;

void expect_rows(std::size_t rows, std::span<const bool> examined, Numbers limits, const NearPoints &near) {
    expect(examined.size() == rows && limits.size() == rows && near.piece.size() == rows && near.roots.size() == rows,
           "samples, examined, limits and near have different lengths: expected a row a sample");
}

}  // namespace

void means_beyond(const BoxTrees &trees, Points points, std::span<const std::array<Node, 4>> samples,
                  std::span<const bool> examined, Numbers limits, const NearPoints &near, std::span<bool> beyond) {
    expect_rows(samples.size(), examined, limits, near);
    expect(beyond.size() == samples.size(), "beyond: one for each of samples is expected");
    expect_known(near.piece, trees.pieces.size());
    expect_roots(near.roots, trees.links.size());
    parallel_for(samples.size(), SAMPLES_PER_CHUNK, [&](std::int64_t i) {
        beyond[i] = false;
        if (!examined[i]) return;
        const V3<double> x = mean_of(points, samples[i]);
        if (length(vector(near.places[i]) - x) <= limits[i]) return;
        const ClosestPoint found = trees.closest(point(x), near.roots[i], limits[i] * limits[i], near.piece[i]);
        near.piece[i] = found.piece, near.weights[i] = found.weights;
        near.places[i] = found.piece < 0 ? Point{INF, INF, INF} : found.place;
        beyond[i] = !(std::sqrt(found.square) <= limits[i]);
    });
}

IntArray samples_beyond(const MovingTrees &trees, Points x, std::span<const bool> examined, Numbers limits,
                        const NearPoints &near) {
    expect_rows(x.size(), examined, limits, near);
    expect_boxes(trees.boxes, trees.links.size());
    std::vector<std::uint8_t> far(x.size());
    expect_known(near.piece, trees.pieces.size());
    expect_roots(near.roots, trees.links.size());
    parallel_for(x.size(), SAMPLES_PER_CHUNK, [&](std::int64_t i) {
        far[i] = examined[i] &&
                 !(distance_from(trees.points, trees.pieces, x[i], near.piece[i], near.weights[i]) <= limits[i]);
    });
    std::vector<std::int32_t> doubtful, beyond;
    auto collect = [&] {
        doubtful.clear();
        for (std::size_t i = 0; i < far.size(); ++i)
            if (far[i]) doubtful.push_back(static_cast<std::int32_t>(i));
        return !doubtful.empty();
    };
    const BoxTrees fitted{trees.points, trees.pieces, trees.boxes, trees.links};
    auto store = [&](std::int32_t i, const ClosestPoint &found) {
        far[i] = !(std::sqrt(found.square) <= limits[i]);
        near.piece[i] = found.piece, near.weights[i] = found.weights;
    };
    if (!collect()) return {};
    parallel_for(doubtful.size(), SEARCHES_PER_CHUNK, [&](std::int64_t k) {  // another point of the same piece
        const std::int32_t i = doubtful[k];
        if (near.piece[i] >= 0 && is_finite(x[i])) store(i, closest_on_piece(fitted, x[i], near.piece[i]));
    });
    if (!collect()) return {};
    refit(trees.points, trees.pieces, trees.links, trees.boxes);
    parallel_for(doubtful.size(), SEARCHES_PER_CHUNK, [&](std::int64_t k) {
        const std::int32_t i = doubtful[k];
        store(i, fitted.closest(x[i], near.roots[i], limits[i] * limits[i], near.piece[i]));
    });
    for (std::int32_t i : doubtful)
        if (far[i]) beyond.push_back(i);
    return {std::move(beyond)};
}

void moved_samples(const BandSamples &samples, Points points, Points earlier, std::span<const bool> boundary_before,
                   std::span<const bool> surface_before, std::span<bool> boundary, std::span<bool> surface) {
    expect(points.size() == earlier.size(), "points and earlier have different lengths: expected a row a node");
    expect(boundary_before.size() == samples.boundary.size() && boundary.size() == samples.boundary.size() &&
               surface_before.size() == samples.pieces.size() && surface.size() == samples.pieces.size(),
           "marks of samples: one for each sample is expected");
    expect_known(samples.pieces, samples.face_of_piece.size());
    std::vector<std::uint8_t> moved(points.size());
    // Without branches, which could not be predicted.
    parallel_for(points.size(), MARKS_PER_CHUNK, [&](std::int64_t i) {
        const Point &a = points[i], &b = earlier[i];
        moved[i] = (a[0] != b[0]) | (a[1] != b[1]) | (a[2] != b[2]);
    });
    auto any = [&](const std::array<Node, 4> &nodes) {
        return moved[nodes[0]] | moved[nodes[1]] | moved[nodes[2]] | moved[nodes[3]];
    };
    std::vector<std::uint8_t> faces(samples.faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f) faces[f] = any(samples.faces[f]);
    parallel_for(boundary.size(), MARKS_PER_CHUNK,
                 [&](std::int64_t i) { boundary[i] = boundary_before[i] | (any(samples.boundary[i]) != 0); });
    parallel_for(surface.size(), MARKS_PER_CHUNK, [&](std::int64_t i) {
        const std::int32_t piece = samples.pieces[i];
        surface[i] = piece < 0 ? true : surface_before[i] | (faces[samples.face_of_piece[piece]] != 0);
    });
}

}  // namespace hexmend
