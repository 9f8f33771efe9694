// The closest point of a surface, by a tree of bounding boxes for each curve and patch.
//
// A piece is a triangle (a, b, c) or a segment (a, b, b) of points. Pieces are ordered by tree; a leaf of a tree holds
// a range of them.
#pragma once

#include <tuple>

#include "mesh/array_views.hpp"

namespace hexmend {

using Piece = std::array<Node, 3>;
using Barycentric = std::array<double, 3>;  // coordinates in a piece
using Box = std::array<double, 6>;          // smallest x, y, z, largest x, y, z
// Of a leaf: its first piece and their number. Of an inner box: its second child and 0; the first child follows its
// parent.
using TreeLink = std::array<std::int32_t, 2>;

// Result of a query; piece is -1 where there is none.
struct ClosestPoint {
    double square = INF;  // of the distance
    std::int32_t piece = -1;
    Point place{};
    Barycentric weights{};
};

// Trees over pieces, for queries of single points.
struct BoxTrees {
    Points points;
    std::span<const Piece> pieces;
    std::span<const Box> boxes;
    std::span<const TreeLink> links;

    // The point closest to x in the tree with that root, or any point at a squared distance of at most `enough`; none
    // where x is not finite. A known piece of the tree that is near shortens the search; -1 where there is none.
    ClosestPoint closest(const Point &x, std::int32_t root, double enough = 0, std::int32_t known = -1) const;
};

// Throw std::invalid_argument for a piece that does not exist; -1 is none.
void expect_known(std::span<const std::int32_t> known, std::size_t pieces);

// Build trees: returns the order of the pieces (k,), boxes (b, 6) and links (b, 2) of all trees, and the root of each.
std::tuple<IntArray, OwnedArray<double, 6>, OwnedArray<std::int32_t, 2>, IntArray> build_trees(
    Points points, std::span<const Piece> pieces, Indices start);

// Update the boxes of trees after their points have moved.
void refit(Points points, std::span<const Piece> pieces, std::span<const TreeLink> links, std::span<Box> boxes);

// Write the piece, closest point and barycentric weights of each x; `enough` is a distance that counts as closest. On
// entry `piece` has a piece of that tree that is near, or -1: it shortens the search.
void closest(const BoxTrees &trees, Points x, Indices roots, double enough, std::span<std::int32_t> piece,
             std::span<Point> places, std::span<Barycentric> weights);

// Write a point of the first tree: one within the limit of each x, or the closest one: its piece, its barycentric
// weights and its distance from x. On entry `piece` has a piece that is near, or -1.
void near(const BoxTrees &trees, Points x, Numbers limits, std::span<std::int32_t> piece,
          std::span<Barycentric> weights, std::span<double> distances);

// Write the distance of each x from the point of a piece with some weights; infinite where the piece is -1.
void distances_from(Points points, std::span<const Piece> pieces, Points x, Indices piece,
                    std::span<const Barycentric> weights, std::span<double> distances);

// Write the mean of each four points.
void means(Points points, std::span<const std::array<Node, 4>> nodes, std::span<Point> x);

}  // namespace hexmend
