// Distances of a surface from a boundary of quads that slides on it.
#pragma once

#include "boundary/near_points.hpp"

namespace hexmend {

// Points of the boundary as means of the nodes of a face with weights.
using FaceNodes = std::array<Node, 4>;
using FaceWeights = std::array<double, 4>;

// Samples x of the surface: their distances from the boundary before sliding, the nodes and weights of the closest
// points then, pieces of the boundary near them, -1 for none, and the roots of the trees searched for them.
struct SurfaceSamples {
    Points x;
    Numbers distances;
    std::span<const FaceNodes> nodes;
    std::span<const FaceWeights> weights;
    Indices pieces, roots;

    void check() const {
        expect(have_rows(x.size(), distances, nodes, weights, pieces, roots),
               "x, distances, nodes, weights, pieces and roots have different lengths: expected a row a sample");
    }
};

// Distances of samples from the boundary now, unit vectors from the closest points to the samples, and the nodes and
// weights of the closest points.
struct SampleDistances {
    std::span<double> distances;
    std::span<Point> directions;
    std::span<FaceNodes> nodes;
    std::span<FaceWeights> weights;
};

// Write the rows `which` of `now`. The trees are those of the boundary's quads, each divided into four triangles around
// its centre; their points are the nodes and then the centres of `faces`. Samples whose closest point at first was at
// no distance and has not moved since `start`, the nodes before sliding, are not searched.
void find_distances(const MovingTrees &trees, Points start, std::span<const FaceNodes> faces,
                    const SurfaceSamples &samples, std::span<const std::int64_t> which, const SampleDistances &now);

}  // namespace hexmend
