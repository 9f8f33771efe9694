// The closest point of a surface, by a tree of bounding boxes for each curve and patch.
//
// A piece is a triangle (a, b, c) or a segment (a, b, b) of points. Pieces are ordered by tree; a leaf of a tree holds
// a range of them. An inner node of a tree has up to four children, whose boxes are tested at once, as are the pieces
// of a leaf.
#pragma once

#include <limits>
#include <tuple>

#include "mesh/array_views.hpp"

namespace hexmend {

using Piece = std::array<Node, 3>;
using Barycentric = std::array<double, 3>;       // coordinates in a piece
constexpr int CHILDREN = 4;                      // of a node of a tree
constexpr int SIDES = 6;                         // of a box: smallest x, y, z, largest x, y, z
using ChildSide = std::array<double, CHILDREN>;  // a side of the box of each child; node n has those from SIDES * n on
// Children of a node: the number of a node, which is greater than that of its parent, or a leaf of `count` pieces from
// `first` on as -1 - (CHILDREN * first + count - 1), or NO_CHILD.
using ChildLinks = std::array<std::int32_t, CHILDREN>;
constexpr std::int32_t NO_CHILD = std::numeric_limits<std::int32_t>::min();

// First piece and number of pieces of a leaf.
inline std::pair<std::int32_t, std::int32_t> pieces_of(std::int32_t leaf) {
    std::int32_t code = -1 - leaf;
    return {code / CHILDREN, code % CHILDREN + 1};
}

// Result of a query; piece is -1 where there is none.
struct ClosestPoint {
    double square = INF;  // of the distance
    std::int32_t piece = -1;
    Point place{};
    Barycentric weights{};
};

// Throw std::invalid_argument unless there are boxes of so many nodes of trees.
inline void expect_boxes(std::span<const ChildSide> boxes, std::size_t nodes) {
    expect(boxes.size() == SIDES * nodes, "boxes: six rows for each of the links are expected");
}

// Trees over pieces, for queries of single points.
struct BoxTrees {
    Points points;
    std::span<const Piece> pieces;
    std::span<const ChildSide> boxes;
    std::span<const ChildLinks> links;

    void check() const { expect_boxes(boxes, links.size()); }

    // The point closest to x in the tree with that root, or any point at a squared distance of at most `enough` > 0;
    // none where x is not finite. A known piece of the tree that is near shortens the search; -1 where there is none.
    // Unless there is `enough`, what is found depends on nothing else: of pieces that are as close, the first has the
    // point.
    ClosestPoint closest(const Point &x, std::int32_t root, double enough = 0, std::int32_t known = -1) const;
};

// Throw std::invalid_argument for a piece that does not exist; -1 is none.
void expect_known(std::span<const std::int32_t> known, std::size_t pieces);

// Throw std::invalid_argument for a root that is none of so many nodes of trees.
void expect_roots(Indices roots, std::size_t nodes);

using TreeBoxes = OwnedArray<double, CHILDREN>;
using TreeLinks = OwnedArray<std::int32_t, CHILDREN>;

// Build trees: returns the order of the pieces (k,), boxes (6 b, 4) and links (b, 4) of all nodes, and the root of each
// tree.
std::tuple<IntArray, TreeBoxes, TreeLinks, IntArray> build_trees(Points points, std::span<const Piece> pieces,
                                                                 Indices start);

// Update the boxes of trees after their points have moved.
void refit(Points points, std::span<const Piece> pieces, std::span<const ChildLinks> links, std::span<ChildSide> boxes);

// Write the piece, closest point and barycentric weights of each x; `enough` is a distance that counts as closest. On
// entry `piece` has a piece of that tree that is near, or -1: it shortens the search.
void closest(const BoxTrees &trees, Points x, Indices roots, double enough, std::span<std::int32_t> piece,
             std::span<Point> places, std::span<Barycentric> weights);

// Write the mean of each four points.
void means(Points points, std::span<const std::array<Node, 4>> nodes, std::span<Point> x);

}  // namespace hexmend
