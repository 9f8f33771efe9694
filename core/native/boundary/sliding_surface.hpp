// The surface on which nodes of the boundary slide: each node is projected onto its own curve or patch, and must not
// flip a boundary quad.
#pragma once

#include "boundary/closest_point_cache.hpp"
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
inline bool is_flipped(const QuadPoints &x, const Point &outward) {
    auto n = vector(outward), a = vector(x[2]) - vector(x[0]), b = vector(x[3]) - vector(x[1]);
    return dot(n, n) > 0 && !(dot(cross(a, b), n) > FLAT_QUAD * std::sqrt(dot(a, a) * dot(b, b)));
}

// Quads of the boundary at the sliding nodes, with the normals of the original surface.
struct BoundaryQuads {
    Indices start;    // (k + 1,): the quad corners at the sliding node in slot s are corners[start[s]] to
                      // corners[start[s + 1] - 1]
    Indices corners;  // 4 * quad + corner
    std::span<const Quad> quads;
    Points outward;  // normal of each quad, or 0 where it has none

    void check() const {
        expect(are_csr(start, corners.size()), "start: its last number is expected to be the length of corners");
        expect(outward.size() == quads.size(), "outward: one for each of the quads is expected");
    }

    // Return True if moving the node in a slot to `place` flips a quad that is not flipped now.
    bool flipped_by_move(Points points, Node slot, const Point &place) const {
        for (auto r = start[slot]; r < start[slot + 1]; ++r) {
            auto f = corners[r] / 4;
            auto now = points_of(points, quads[f]), then = now;
            then[corners[r] % 4] = place;
            if (!is_flipped(now, outward[f]) && is_flipped(then, outward[f])) return true;
        }
        return false;
    }
};

// Curves and patches with the nodes that slide on them.
struct SlidingSurface {
    Indices slots;                   // (n,): number of a node among the sliding ones, -1 for others
    const ClosestPointCache *cache;  // of each sliding node, on its curve or patch
    BoundaryQuads quads;

    void check() const {
        expect(quads.start.size() == cache->size() + 1, "quads: rows of each slot of the cache are expected");
    }

    std::size_t count() const { return cache->size(); }

    bool slides(Node i) const { return slots[i] >= 0; }

    // The point of node i's curve or patch closest to x; x itself where it is not finite.
    Point project(Node i, const Point &x) const {
        ClosestPoint found = cache->closest(slots[i], x);
        return found.piece < 0 ? x : found.place;
    }

    // The projection of x, or the node's present position where the move would flip a quad.
    Point project_unless_flipping(Points points, Node i, const Point &x) const {
        Point place = project(i, x);
        return quads.flipped_by_move(points, slots[i], place) ? points[i] : place;
    }
};

// Throw unless there is no surface or it is one of a mesh with so many nodes.
inline void expect_nodes(const SlidingSurface *surface, std::size_t nodes) {
    expect(!surface || surface->slots.size() == nodes, "surface: a slot for each node is expected");
}

}  // namespace hexmend
