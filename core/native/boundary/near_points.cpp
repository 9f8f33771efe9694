#include "boundary/near_points.hpp"

#include "simd/threads.hpp"

namespace hexmend {
namespace {

constexpr std::int64_t SAMPLES_PER_CHUNK = 1024;

void expect_rows(std::size_t rows, std::span<const bool> examined, Numbers limits, const NearPoints &near,
                 std::span<bool> found) {
    expect(examined.size() == rows && limits.size() == rows && near.piece.size() == rows && found.size() == rows,
           "samples, examined, limits, near and the result have different lengths: expected a row a sample");
}

}  // namespace

void means_beyond(const BoxTrees &trees, Points points, std::span<const std::array<Node, 4>> samples,
                  std::span<const bool> examined, Numbers limits, const NearPoints &near, std::span<bool> beyond) {
    expect_rows(samples.size(), examined, limits, near, beyond);
    expect_known(near.piece, trees.pieces.size());
    parallel_for(samples.size(), SAMPLES_PER_CHUNK, [&](std::int64_t i) {
        beyond[i] = false;
        if (!examined[i]) return;
        const V3<double> x = mean_of(points, samples[i]);
        if (length(vector(near.places[i]) - x) <= limits[i]) return;
        const ClosestPoint found = trees.closest(point(x), 0, limits[i] * limits[i], near.piece[i]);
        near.piece[i] = found.piece, near.weights[i] = found.weights;
        near.places[i] = found.piece < 0 ? Point{INF, INF, INF} : found.place;
        beyond[i] = !(std::sqrt(found.square) <= limits[i]);
    });
}

void far_samples(Points points, std::span<const Piece> pieces, Points x, std::span<const bool> examined, Numbers limits,
                 const NearPoints &near, std::span<bool> far) {
    expect_rows(x.size(), examined, limits, near, far);
    expect_known(near.piece, pieces.size());
    parallel_for(x.size(), SAMPLES_PER_CHUNK, [&](std::int64_t i) {
        far[i] = examined[i] && !(distance_from(points, pieces, x[i], near.piece[i], near.weights[i]) <= limits[i]);
    });
}

}  // namespace hexmend
