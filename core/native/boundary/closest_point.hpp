// The closest point of a surface: triangles and segments in trees of boxes, one tree for each curve and patch.
//
// A piece is a triangle (a, b, c), or a segment (a, b, b). Pieces are ordered by tree; a tree's leaf holds some that
// follow each other.
#pragma once

#include <tuple>

#include "mesh/array_views.hpp"

namespace hexmend {

using Piece = std::array<Node, 3>;
using Barycentric = std::array<double, 3>;  // of the corners of a piece
using Box = std::array<double, 6>;          // least x, y, z, greatest x, y, z
// Of a leaf its first piece and how many it holds; else the second child (the first follows its parent) and 0.
using TreeLink = std::array<std::int32_t, 2>;

struct ClosestPoint {
    double square = INF;  // of the distance
    std::int32_t piece = -1;
    Point place{};
    Barycentric weights{};  // of the piece's corners
};

// What `closest` of a whole array sees; for kernels that move nodes one by one.
struct BoxTrees {
    Points points;
    std::span<const Piece> pieces;
    std::span<const Box> boxes;
    std::span<const TreeLink> links;

    // The point closest to x in the tree that begins at `root`, or any whose square distance is at most `enough`; no
    // piece where x is not finite.
    ClosestPoint closest(const Point &x, std::int32_t root, double enough = 0) const;
};

// The order of pieces in trees, the boxes and links of all trees, and where each begins. Tree t is made of the pieces
// start[t] to start[t + 1] - 1, of which there is at least one.
std::tuple<OwnedArray<std::int32_t>, OwnedArray<double, 6>, OwnedArray<std::int32_t, 2>, OwnedArray<std::int32_t>>
trees(Points points, std::span<const Piece> pieces, Indices start);

// The boxes of trees whose points have moved.
void refit(Points points, std::span<const Piece> pieces, std::span<const TreeLink> links, std::span<Box> boxes);

void closest(Points points, std::span<const Piece> pieces, std::span<const Box> boxes, std::span<const TreeLink> links,
             Points x, Indices roots, double enough, std::span<std::int32_t> piece, std::span<Point> places,
             std::span<Barycentric> weights);

}  // namespace hexmend
