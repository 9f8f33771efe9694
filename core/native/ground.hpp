// What nodes of the boundary slide on: each is put back on its own curve or patch, and may not turn a quad over.
#pragma once

#include "closest.hpp"
#include "vectors.hpp"

namespace hexmend {

using Quad = std::array<Node, 4>;

// A corner of a quad between the node before it and the one after.
struct QuadCorner {
    Point before, at, after;
};

inline QuadCorner corners_of(Points points, const Quad &quad, int c) {
    return {points[quad[(c + 3) % 4]], points[quad[c]], points[quad[(c + 1) % 4]]};
}

// A corner whose sine is no more than this is flat to rounding.
constexpr double FLAT_CORNER = 1e-9;

// Whether a corner's normal is against that of the surface, or the corner is flat. Where there is no normal none is.
inline bool is_turned(const QuadCorner &of, const Point &outward) {
    V3<double> n{outward[0], outward[1], outward[2]};
    V3<double> a{of.after[0] - of.at[0], of.after[1] - of.at[1], of.after[2] - of.at[2]};
    V3<double> b{of.before[0] - of.at[0], of.before[1] - of.at[1], of.before[2] - of.at[2]};
    return dot(n, n) > 0 && !(dot(cross(a, b), n) > FLAT_CORNER * std::sqrt(dot(a, a) * dot(b, b)));
}

// The quads of the boundary at nodes that slide, and the normals that they had at first.
struct Quads {
    Indices start;    // where those of each node that slides begin
    Indices corners;  // 4 * quad + corner
    std::span<const Quad> quads;
    Points outward;  // of each quad

    // Whether a corner that is not turned would be if node i, of that slot, were at `place`.
    bool turns(Points points, Node slot, Node i, const Point &place) const {
        for (auto r = start[slot]; r < start[slot + 1]; ++r) {
            auto quad = quads[corners[r] / 4];
            const auto &normal = outward[corners[r] / 4];
            for (int c = corners[r] % 4 + 3, end = c + 3; c < end; ++c) {  // that opposite stays
                auto now = corners_of(points, quad, c % 4), then = now;
                if (quad[(c + 3) % 4] == i) then.before = place;
                if (quad[c % 4] == i) then.at = place;
                if (quad[(c + 1) % 4] == i) then.after = place;
                if (!is_turned(now, normal) && is_turned(then, normal)) return true;
            }
        }
        return false;
    }
};

struct Ground {
    Indices slots;  // of each node among those that slide, -1 of others
    Indices roots;  // of each of those its tree
    Pieces pieces;
    Quads quads;

    bool slides(Node i) const { return slots[i] >= 0; }

    // The closest place to x of what node i slides on; x itself where that is not finite.
    Point put_back(Node i, const Point &x) const {
        Closest found = pieces.closest(x, roots[slots[i]]);
        return found.piece < 0 ? x : found.place;
    }

    // The same, or where the node is if it would turn a quad from there.
    Point led(Points points, Node i, const Point &x) const {
        Point place = put_back(i, x);
        return quads.turns(points, slots[i], i, place) ? points[i] : place;
    }
};

}  // namespace hexmend
