// Distances of a boundary that moves from the surface that it had: samples of each are compared with the closest points
// of the other, and the distances are terms of an energy.
#pragma once

#include "boundary/closest_point_cache.hpp"

namespace hexmend {

using SampleNodes = std::array<Node, 4>;
using SampleWeights = std::array<double, 4>;

// Samples of the boundary and of the surface: the first s rows are those of the boundary, each the mean of four nodes;
// the others are the first of these, on the surface as it was. A sample with slot -1 is compared with its own first
// position; others with the tree of their curve or patch, of the surface and of the boundary as it is.
struct FitSamples {
    std::span<const SampleNodes> nodes;          // (s,)
    Points first;                                // (s,) positions on the surface
    Indices slots;                               // (s,) in the cache
    Indices roots;                               // (s,) in the trees of the moving boundary
    const ClosestPointCache *surface;            // closest points of the surface
    std::span<const Point> directions;           // unit normals and tangents of the pieces of the surface
    std::span<const std::array<Node, 4>> faces;  // of the boundary; the centre of face f is vertex n + f
};

// Of each sample: the vector from the closest point to the sample of the boundary, or from the sample of the
// surface to the closest point; its length; the unit normal or tangent there; the nodes that move with it, and their
// weights.
struct FitResult {
    std::span<double> distances;
    std::span<Point> vectors, directions;
    std::span<SampleNodes> nodes;
    std::span<SampleWeights> weights;
};

// Compare at the vertices of the boundary, n nodes and the centres of faces, of the moving trees, whose boxes are up to
// date; rows (k,) of the result alone, of which each is named once. `known` has a piece near each sample of the
// surface, or -1, and is written.
void fit_distances(const FitSamples &samples, const BoxTrees &moving, Indices rows, std::span<std::int32_t> known,
                   const FitResult &result);

// Add vectors (k,), weighted, to the rows of their nodes.
void fit_gradient(std::span<const SampleNodes> nodes, std::span<const SampleWeights> weights, Points vectors,
                  std::span<Point> gradient);

// Derivatives of the cost of each sample by its distance: the first divided by the distance, and the second. A sample
// near a line, or a point, has the force of its distance across it; one near a plane moves freely along it.
struct FitCosts {
    Numbers first, second;
    std::span<const bool> of_line;
};

// Add second derivatives, without those of the curvature of the surface, to the matrix of the pairs of slots (k, 4) of
// each sample, -1 for none.
template <class Real>
void fit_hessian(std::span<const SampleNodes> slots, const FitResult &result, const FitCosts &costs, Indices row_start,
                 Indices columns, std::span<std::array<Real, 9>> off_diagonal, std::span<std::array<Real, 6>> diagonal);

}  // namespace hexmend
