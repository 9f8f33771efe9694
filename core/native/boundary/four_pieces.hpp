// Four pieces whose distances from a point are computed at once.
#pragma once

#include <algorithm>
#include <cstring>

#include "boundary/closest_point.hpp"
#include "simd/vectors.hpp"

namespace hexmend {

// Largest number of nodes and leaves that wait: each of 21 levels leaves three behind.
constexpr int MOST_WAITING = 64;

// A number for each child of a node, or for each of four pieces.
typedef double Four __attribute__((vector_size(8 * CHILDREN)));

inline V3<Four> broadcast_point(const Point &x) { return {x[0] - Four{}, x[1] - Four{}, x[2] - Four{}}; }

inline bool is_finite(const Point &x) { return std::abs(x[0]) < INF && std::abs(x[1]) < INF && std::abs(x[2]) < INF; }

// Fewer than four pieces are padded with the last.
struct FourPieces {
    Four corners[9];  // x, y, z of the first, the second and the third corner
    Four segment;     // 1 for a segment, 0 for a triangle
    std::int32_t numbers[CHILDREN];

    V3<Four> corner(int k) const { return {corners[3 * k], corners[3 * k + 1], corners[3 * k + 2]}; }
};

// Gather pieces; number_of(i) is the number of the one in place i.
template <class NumberOf>
inline FourPieces gather(Points points, std::span<const Piece> pieces, const NumberOf &number_of) {
    FourPieces four;
    for (int i = 0; i < CHILDREN; ++i) {
        four.numbers[i] = number_of(i);
        const Piece &piece = pieces[four.numbers[i]];
        four.segment[i] = piece[1] == piece[2];
        for (int k = 0; k < 9; ++k) four.corners[k][i] = points[piece[k / 3]][k % 3];
    }
    return four;
}

// The pieces of a leaf.
inline FourPieces gather_leaf(const BoxTrees &trees, std::int32_t first, std::int32_t count) {
    return gather(trees.points, trees.pieces, [&](int i) { return first + std::min(i, count - 1); });
}

// Replace `best` if one of four pieces is closer to x; of two that are as close, the one with the lower number is best.
// Return the squared distances of all four. It is not inlined: a piece has the same distance among any others.
Four improve(ClosestPoint &best, const FourPieces &four, const V3<Four> &x);

// The point of one piece closest to x, which is finite.
inline ClosestPoint closest_on_piece(const BoxTrees &trees, const Point &x, std::int32_t piece) {
    ClosestPoint found;
    improve(found, gather_leaf(trees, piece, 1), broadcast_point(x));
    return found;
}

// Squared distances of x from the boxes of children.
inline Four squares_to(const ChildSide *boxes, const V3<Four> &x) {
    Four side[SIDES];
    std::memcpy(side, boxes, sizeof side);
    auto outside = [](Four low, Four high, Four x) { return max(max(low - x, x - high), Four{}); };
    Four a = outside(side[0], side[3], x.x), b = outside(side[1], side[4], x.y), c = outside(side[2], side[5], x.z);
    return a * a + b * b + c * c;
}

// Visit leaves of the tree with that root, the nearer children of a node first: limit = visit(first piece, number of
// pieces) returns the squared distance from x beyond which boxes are left out from now on.
template <class Visit>
inline void visit_leaves(const BoxTrees &trees, std::int32_t root, const V3<Four> &x, double limit,
                         const Visit &visit) {
    std::pair<std::int32_t, double> waiting[MOST_WAITING];
    int size = 0;
    waiting[size++] = {root, 0.0};
    while (size) {
        auto [child, square] = waiting[--size];
        if (square > limit) continue;
        if (child < 0) {
            auto [first, count] = pieces_of(child);
            limit = visit(first, count);
            continue;
        }
        expect(size + CHILDREN <= MOST_WAITING, "links: trees of 21 levels at most are expected");
        Four squares = squares_to(&trees.boxes[std::size_t{SIDES} * child], x);
        int begin = size;
        for (int i = 0; i < CHILDREN; ++i) {
            if (trees.links[child][i] == NO_CHILD || !(squares[i] <= limit)) continue;
            int place = size++;  // the nearest is popped first
            for (; place > begin && waiting[place - 1].second < squares[i]; --place)
                waiting[place] = waiting[place - 1];
            waiting[place] = {trees.links[child][i], squares[i]};
        }
    }
}

}  // namespace hexmend
