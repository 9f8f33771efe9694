// Points of surfaces that were near samples before: they tell which samples cannot be far from a surface now, without a
// search.
#pragma once

#include "boundary/closest_point.hpp"
#include "simd/vectors.hpp"

namespace hexmend {

// The point near to each sample: the piece on which it lies, -1 for none, its barycentric weights there, and its
// position, infinite for none; and the root of the tree that is searched for the sample.
struct NearPoints {
    std::span<std::int32_t> piece;
    std::span<Barycentric> weights;
    std::span<Point> places;
    Indices roots;

    void check() const {
        expect(have_rows(piece.size(), weights, places, roots),
               "piece, weights, places and roots have different lengths: expected a row a sample");
    }
};

// Trees whose points have moved; the boxes are storage for those that fit them.
struct MovingTrees {
    Points points;
    std::span<const Piece> pieces;
    std::span<const ChildLinks> links;
    std::span<ChildSide> boxes;
};

// The mean of four points.
inline V3<double> mean_of(Points points, const std::array<Node, 4> &nodes) {
    V3<double> sum = vector(points[nodes[0]]);
    for (int k = 1; k < 4; ++k) sum = sum + vector(points[nodes[k]]);
    return 0.25 * sum;
}

// The distance of x from the point of a piece with some weights; infinite where the piece is -1.
inline double distance_from(Points points, std::span<const Piece> pieces, const Point &x, std::int32_t piece,
                            const Barycentric &weights) {
    if (piece < 0) return INF;
    auto [a, b, c] = pieces[piece];
    V3<double> known = weights[0] * vector(points[a]) + weights[1] * vector(points[b]) + weights[2] * vector(points[c]);
    return length(known - vector(x));
}

// Write `beyond`: whether the mean of four points is further than its limit from its tree, false for samples that are
// not examined. Points that are found are stored.
void means_beyond(const BoxTrees &trees, Points points, std::span<const std::array<Node, 4>> samples,
                  std::span<const bool> examined, Numbers limits, const NearPoints &near, std::span<bool> beyond);

// The numbers of the examined samples x that are further than their limits from their trees, whose points have moved:
// the boxes are refitted where one is further from the piece near it. Points that are found are stored, but for their
// places.
IntArray samples_beyond(const MovingTrees &trees, Points x, std::span<const bool> examined, Numbers limits,
                        const NearPoints &near);

// Samples of a boundary, means of four nodes, and of the surface on which it slides, each near to a piece of a face of
// the boundary.
struct BandSamples {
    std::span<const std::array<Node, 4>> boundary, faces;
    std::span<const std::int64_t> face_of_piece;
    Indices pieces;  // near to samples of the surface, -1 for none
};

// Mark samples of the boundary and of the surface that were marked before, `boundary_before` and `surface_before`, or
// one of whose nodes differs between points and `earlier`.
void moved_samples(const BandSamples &samples, Points points, Points earlier, std::span<const bool> boundary_before,
                   std::span<const bool> surface_before, std::span<bool> boundary, std::span<bool> surface);

}  // namespace hexmend
