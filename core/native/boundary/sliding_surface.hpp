// What nodes of the boundary slide on: each is put back on its own curve or patch, and may not turn a quad over.
#pragma once

#include "boundary/closest_point.hpp"
#include "simd/vectors.hpp"

namespace hexmend {

using Quad = std::array<Node, 4>;

using QuadPoints = std::array<Point, 4>;

inline QuadPoints points_of(Points points, const Quad &quad) {
    return {points[quad[0]], points[quad[1]], points[quad[2]], points[quad[3]]};
}

// A quad whose diagonals are at a sine of no more than this to each other, seen along the normal, is flat to rounding.
constexpr double FLAT_QUAD = 1e-9;

// Whether a quad's own normal is against that of the surface, or has no part along it. Where there is none none is.
inline bool is_inverted(const QuadPoints &x, const Point &outward) {
    V3<double> n{outward[0], outward[1], outward[2]};
    V3<double> a{x[2][0] - x[0][0], x[2][1] - x[0][1], x[2][2] - x[0][2]};
    V3<double> b{x[3][0] - x[1][0], x[3][1] - x[1][1], x[3][2] - x[1][2]};
    return dot(n, n) > 0 && !(dot(cross(a, b), n) > FLAT_QUAD * std::sqrt(dot(a, a) * dot(b, b)));
}

// The quads of the boundary at nodes that slide, and the normals that they had at first.
struct Quads {
    Indices start;    // where those of each node that slides begin
    Indices corners;  // 4 * quad + corner
    std::span<const Quad> quads;
    Points outward;  // of each quad

    // Whether a quad that is not turned would be if the node of that slot were at `place`.
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

struct SlidingSurface {
    Indices slots;  // of each node among those that slide, -1 of others
    Indices roots;  // of each of those its tree
    BoxTrees pieces;
    Quads quads;

    bool slides(Node i) const { return slots[i] >= 0; }

    // The closest place to x of what node i slides on; x itself where that is not finite.
    Point project(Node i, const Point &x) const {
        ClosestPoint found = pieces.closest(x, roots[slots[i]]);
        return found.piece < 0 ? x : found.place;
    }

    // The same, or where the node is if it would turn a quad from there.
    Point project_unless_inverting(Points points, Node i, const Point &x) const {
        Point place = project(i, x);
        return quads.inverted_by_move(points, slots[i], place) ? points[i] : place;
    }
};

}  // namespace hexmend
