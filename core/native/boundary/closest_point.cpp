#include "boundary/closest_point.hpp"

#include "boundary/four_pieces.hpp"
#include "boundary/near_points.hpp"
#include "simd/threads.hpp"
#include "simd/vectors.hpp"

namespace hexmend {
namespace {

constexpr std::int64_t POINTS_PER_CHUNK = 256;

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

}  // namespace

__attribute__((noinline)) Four improve(ClosestPoint &best, const FourPieces &four, const V3<Four> &x) {
    V3<Four> a = four.corner(0), b = four.corner(1), c = four.corner(2);
    V3<Four> u = b - a, v = c - a, weights = nearest(u, v, x - a, four.segment);
    V3<Four> place = a + (weights.y * u + weights.z * v);
    place = select(weights.x == 1, a, place);  // exactly
    place = select(weights.y == 1, b, place);
    place = select(weights.z == 1, c, place);
    Four far = square(place - x);
    auto precedes = [&](int i, double square, std::int32_t piece) {
        return far[i] < square || (far[i] == square && four.numbers[i] < piece);
    };
    int i = 0;
    for (int k = 1; k < CHILDREN; ++k)
        if (precedes(k, far[i], four.numbers[i])) i = k;
    if (precedes(i, best.square, best.piece))
        best = {
            far[i], four.numbers[i], {place.x[i], place.y[i], place.z[i]}, {weights.x[i], weights.y[i], weights.z[i]}};
    return far;
}

void expect_known(std::span<const std::int32_t> known, std::size_t pieces) {
    auto count = static_cast<std::int32_t>(pieces);
    for (std::int32_t piece : known) expect(piece < count, "piece: a number is out of range");
}

void expect_roots(Indices roots, std::size_t nodes) {
    auto count = static_cast<std::int64_t>(nodes);
    for (std::int32_t root : roots) expect(root >= 0 && root < count, "roots: a number is out of range");
}

ClosestPoint BoxTrees::closest(const Point &at, std::int32_t root, double enough, std::int32_t known) const {
    ClosestPoint best;
    if (!is_finite(at)) return best;
    V3<Four> x = broadcast_point(at);
    auto limit = [&] { return enough > 0 && best.square <= enough ? -1.0 : best.square; };  // no box is that near
    if (known >= 0) improve(best, gather_leaf(*this, known, 1), x);
    visit_leaves(*this, root, x, limit(), [&](std::int32_t first, std::int32_t count) {
        improve(best, gather_leaf(*this, first, count), x);
        return limit();
    });
    return best;
}

void closest(const BoxTrees &trees, Points x, Indices roots, double enough, std::span<std::int32_t> piece,
             std::span<Point> places, std::span<Barycentric> weights) {
    expect(have_rows(x.size(), roots, piece, places, weights),
           "x, roots, piece, places and weights have different lengths: expected a row a point");
    expect_known(piece, trees.pieces.size());
    expect_roots(roots, trees.links.size());
    parallel_chunks(x.size(), POINTS_PER_CHUNK, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
            // The point before it is often near.
            bool follows = piece[i] < 0 && i > begin && roots[i] == roots[i - 1];
            std::int32_t known = follows ? piece[i - 1] : piece[i];
            ClosestPoint found = trees.closest(x[i], roots[i], enough * enough, known);
            piece[i] = found.piece, places[i] = found.place, weights[i] = found.weights;
        }
    });
}

void means(Points points, std::span<const std::array<Node, 4>> nodes, std::span<Point> x) {
    expect(x.size() == nodes.size(), "x: a row for each of nodes is expected");
    parallel_for(x.size(), POINTS_PER_CHUNK, [&](std::int64_t i) { x[i] = point(mean_of(points, nodes[i])); });
}

}  // namespace hexmend
