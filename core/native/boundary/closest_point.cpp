#include "boundary/closest_point.hpp"

#include <algorithm>

#include "simd/threads.hpp"
#include "simd/vectors.hpp"

namespace hexmend {
namespace {

// Largest number of nodes and leaves that wait: each of 16 levels leaves three behind.
constexpr int MOST_WAITING = 64;
constexpr std::int64_t POINTS_PER_CHUNK = 256;

// A number for each child of a node, or each piece of a leaf.
typedef double Four __attribute__((vector_size(8 * CHILDREN)));

inline V3<Four> broadcast_point(const Point &x) { return {x[0] - Four{}, x[1] - Four{}, x[2] - Four{}}; }

// Squared distances of x from the boxes of children.
inline Four squares_to(const ChildSide *boxes, const V3<Four> &x) {
    Four side[SIDES];
    std::memcpy(side, boxes, sizeof side);
    auto outside = [](Four low, Four high, Four x) { return max(max(low - x, x - high), Four{}); };
    Four a = outside(side[0], side[3], x.x), b = outside(side[1], side[4], x.y), c = outside(side[2], side[5], x.z);
    return a * a + b * b + c * c;
}

// Parameter t in [0, 1] of the point of the segment a + t d closest to a + p; 0 where its ends are one.
inline Four along(const V3<Four> &d, const V3<Four> &p) {
    Four whole = square(d), one = 1.0 - Four{};
    Four t = min(max(dot(p, d) / whole, Four{}), one);
    return whole > 0 ? t : Four{};
}

inline V3<Four> select(const auto &which, const V3<Four> &a, const V3<Four> &b) {
    return {which ? a.x : b.x, which ? a.y : b.y, which ? a.z : b.z};
}

// Barycentric coordinates of the points of triangles (a, a + u, a + v) closest to a + p; of segments (a, a + u) where
// that is 1.
inline V3<Four> nearest(const V3<Four> &u, const V3<Four> &v, const V3<Four> &p, const Four &segment) {
    V3<Four> n = cross(u, v);
    Four whole = square(n), one = 1.0 - Four{};
    Four second = dot(cross(p, v), n) / whole, third = dot(cross(u, p), n) / whole;
    // Outside the triangle, or of a triangle without area, the closest point is on an edge.
    Four on_u = along(u, p), on_v = along(v, p), across = along(v - u, p - u);
    Four from_u = square(on_u * u - p), from_v = square(on_v * v - p), from_across = square(u + across * (v - u) - p);
    V3<Four> first{one - on_u, on_u, Four{}};
    auto closer = from_v < from_u;
    V3<Four> weights = select(closer, V3<Four>{one - on_v, Four{}, on_v}, first);
    weights = select(from_across < (closer ? from_v : from_u), V3<Four>{Four{}, one - across, across}, weights);
    auto inside = (whole > 0) & (second >= 0) & (third >= 0) & (second + third <= 1);
    weights = select(inside, V3<Four>{one - second - third, second, third}, weights);
    return select(segment > 0, first, weights);
}

// Replace `best` if one of `count` pieces from number `first` on is closer to x; of two that are as close, the first is
// best, but at distance 0 the search ends at either. It is not inlined: a piece has the same distance in any leaf.
__attribute__((noinline)) void improve(ClosestPoint &best, Points points, std::span<const Piece> pieces,
                                       std::int32_t first, std::int32_t count, const V3<Four> &x) {
    V3<Four> corners[3];
    Four segment;
    for (int i = 0; i < CHILDREN; ++i) {
        const Piece &piece = pieces[first + std::min(i, count - 1)];
        segment[i] = piece[1] == piece[2];
        for (int k = 0; k < 3; ++k) {
            const Point &corner = points[piece[k]];
            corners[k].x[i] = corner[0], corners[k].y[i] = corner[1], corners[k].z[i] = corner[2];
        }
    }
    V3<Four> a = corners[0], u = corners[1] - a, v = corners[2] - a, weights = nearest(u, v, x - a, segment);
    V3<Four> place = a + (weights.y * u + weights.z * v);
    place = select(weights.x == 1, a, place);  // exactly
    place = select(weights.y == 1, corners[1], place);
    place = select(weights.z == 1, corners[2], place);
    Four far = square(place - x);
    int i = 0;
    for (int k = 1; k < count; ++k)
        if (far[k] < far[i]) i = k;
    if (far[i] < best.square || (far[i] == best.square && first + i < best.piece))
        best = {far[i], first + i, {place.x[i], place.y[i], place.z[i]}, {weights.x[i], weights.y[i], weights.z[i]}};
}

}  // namespace

void expect_known(std::span<const std::int32_t> known, std::size_t pieces) {
    auto count = static_cast<std::int32_t>(pieces);
    for (std::int32_t piece : known) expect(piece < count, "piece: a number is out of range");
}

ClosestPoint BoxTrees::closest(const Point &at, std::int32_t root, double enough, std::int32_t known) const {
    ClosestPoint best;
    if (!(std::abs(at[0]) < INF && std::abs(at[1]) < INF && std::abs(at[2]) < INF)) return best;
    V3<Four> x = broadcast_point(at);
    if (known >= 0) improve(best, points, pieces, known, 1, x);
    std::pair<std::int32_t, double> waiting[MOST_WAITING];
    int size = 0;
    waiting[size++] = {root, 0.0};
    while (size && best.square > enough) {
        auto [child, square] = waiting[--size];
        if (square > best.square) continue;
        if (child < 0) {
            auto [first, count] = pieces_of(child);
            improve(best, points, pieces, first, count, x);
            continue;
        }
        Four squares = squares_to(&boxes[std::size_t{SIDES} * child], x);
        int begin = size;
        for (int i = 0; i < CHILDREN; ++i) {
            if (links[child][i] == NO_CHILD || !(squares[i] <= best.square)) continue;
            int place = size++;  // the nearest is popped first
            for (; place > begin && waiting[place - 1].second < squares[i]; --place)
                waiting[place] = waiting[place - 1];
            waiting[place] = {links[child][i], squares[i]};
        }
    }
    return best;
}

void closest(const BoxTrees &trees, Points x, Indices roots, double enough, std::span<std::int32_t> piece,
             std::span<Point> places, std::span<Barycentric> weights) {
    expect(
        roots.size() == x.size() && piece.size() == x.size() && places.size() == x.size() && weights.size() == x.size(),
        "x, roots, piece, places and weights have different lengths: expected a row a point");
    expect_known(piece, trees.pieces.size());
    parallel_for(x.size(), POINTS_PER_CHUNK, [&](std::int64_t i) {
        ClosestPoint found = trees.closest(x[i], roots[i], enough * enough, piece[i]);
        piece[i] = found.piece, places[i] = found.place, weights[i] = found.weights;
    });
}

void near(const BoxTrees &trees, Points x, Numbers limits, std::span<std::int32_t> piece,
          std::span<Barycentric> weights, std::span<double> distances) {
    expect(limits.size() == x.size() && piece.size() == x.size() && weights.size() == x.size() &&
               distances.size() == x.size(),
           "x, limits, piece, weights and distances have different lengths: expected a row a point");
    expect_known(piece, trees.pieces.size());
    parallel_for(x.size(), POINTS_PER_CHUNK, [&](std::int64_t i) {
        ClosestPoint found = trees.closest(x[i], 0, limits[i] * limits[i], piece[i]);
        piece[i] = found.piece, weights[i] = found.weights, distances[i] = std::sqrt(found.square);
    });
}

void distances_from(Points points, std::span<const Piece> pieces, Points x, Indices piece,
                    std::span<const Barycentric> weights, std::span<double> distances) {
    expect(piece.size() == x.size() && weights.size() == x.size() && distances.size() == x.size(),
           "x, piece, weights and distances have different lengths: expected a row a point");
    expect_known(piece, pieces.size());
    parallel_for(x.size(), POINTS_PER_CHUNK, [&](std::int64_t i) {
        distances[i] = INF;
        if (piece[i] < 0) return;
        auto [a, b, c] = pieces[piece[i]];
        V3<double> known =
            weights[i][0] * vector(points[a]) + weights[i][1] * vector(points[b]) + weights[i][2] * vector(points[c]);
        distances[i] = std::sqrt(square(known - vector(x[i])));
    });
}

void means(Points points, std::span<const std::array<Node, 4>> nodes, std::span<Point> x) {
    expect(x.size() == nodes.size(), "x: a row for each of nodes is expected");
    parallel_for(x.size(), POINTS_PER_CHUNK, [&](std::int64_t i) {
        V3<double> sum = vector(points[nodes[i][0]]);
        for (int k = 1; k < 4; ++k) sum = sum + vector(points[nodes[i][k]]);
        x[i] = point(0.25 * sum);
    });
}

}  // namespace hexmend
