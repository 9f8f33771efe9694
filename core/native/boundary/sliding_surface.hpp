// The surface on which nodes of the boundary slide: each node is projected onto its own curve or patch, and must not
// invert a boundary quad.
#pragma once

#include "boundary/closest_point.hpp"
#include "simd/vectors.hpp"

namespace hexmend {

using Quad = std::array<Node, 4>;

using QuadPoints = std::array<Point, 4>;

inline QuadPoints points_of(Points points, const Quad &quad) {
    return {points[quad[0]], points[quad[1]], points[quad[2]], points[quad[3]]};
}

// A quad is flat where the sine of the angle of its diagonals, projected along the normal, is not above this.
constexpr double FLAT_QUAD = 1e-9;

// Return True if a quad's normal points against `outward` or has no component along it; False if outward is 0.
inline bool is_inverted(const QuadPoints &x, const Point &outward) {
    V3<double> n{outward[0], outward[1], outward[2]};
    V3<double> a{x[2][0] - x[0][0], x[2][1] - x[0][1], x[2][2] - x[0][2]};
    V3<double> b{x[3][0] - x[1][0], x[3][1] - x[1][1], x[3][2] - x[1][2]};
    return dot(n, n) > 0 && !(dot(cross(a, b), n) > FLAT_QUAD * std::sqrt(dot(a, a) * dot(b, b)));
}

// Quads of the boundary at the sliding nodes, with the normals of the original surface.
struct BoundaryQuads {
    Indices start;    // (k + 1,): the quad corners at the sliding node in slot s are corners[start[s]] to
                      // corners[start[s + 1] - 1]
    Indices corners;  // 4 * quad + corner
    std::span<const Quad> quads;
    Points outward;  // normal of each quad, or 0 where it has none

    // Return True if moving the node in a slot to `place` inverts a quad that is not inverted now.
    bool inverted_by_move(Points points, Node slot, const Point &place) const {
        for (auto r = start[slot]; r < start[slot + 1]; ++r) {
            auto f = corners[r] / 4;
            auto now = points_of(points, quads[f]), then = now;
            then[corners[r] % 4] = place;
            if (!is_inverted(now, outward[f]) && is_inverted(then, outward[f])) return true;
        }
        return false;
    }
};

// Curves and patches with the nodes that slide on them.
struct SlidingSurface {
    Indices slots;   // (n,): number of a node among the sliding ones, -1 for others
    Indices roots;   // (k,): root box of the tree of each sliding node's curve or patch
    BoxTrees trees;  // of all curves and patches
    BoundaryQuads quads;

    bool slides(Node i) const { return slots[i] >= 0; }

    // The point of node i's curve or patch closest to x; x itself where it is not finite.
    Point project(Node i, const Point &x) const {
        ClosestPoint found = trees.closest(x, roots[slots[i]]);
        return found.piece < 0 ? x : found.place;
    }

    // The projection of x, or the node's present position where the move would invert a quad.
    Point project_unless_inverting(Points points, Node i, const Point &x) const {
        Point place = project(i, x);
        return quads.inverted_by_move(points, slots[i], place) ? points[i] : place;
    }
};

}  // namespace hexmend
