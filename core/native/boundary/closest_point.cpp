#include "boundary/closest_point.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "simd/threads.hpp"

namespace hexmend {
namespace {

using Vector = V3<double>;

constexpr std::int32_t LEAF = 4;  // largest number of pieces in a leaf
constexpr int DEEPEST = 64;       // depth of the stack; halving 2^31 pieces needs half of it
constexpr std::int64_t POINTS_PER_CHUNK = 256;

constexpr Box EMPTY{INF, INF, INF, -INF, -INF, -INF};

// Extend a box to a point.
void include(Box &box, const Point &x) {
    for (int k = 0; k < 3; ++k) box[k] = std::min(box[k], x[k]), box[k + 3] = std::max(box[k + 3], x[k]);
}

struct TreeBuilder {
    Points points;
    std::span<const Piece> pieces;
    std::vector<Point> centres;
    std::vector<std::int32_t> order;
    std::vector<double> boxes;
    std::vector<std::int32_t> links;

    TreeBuilder(Points points_, std::span<const Piece> pieces_)
        : points(points_), pieces(pieces_), centres(pieces_.size()), order(pieces_.size()) {
        std::iota(order.begin(), order.end(), 0);
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            auto [a, b, c] = pieces[i];
            for (int k = 0; k < 3; ++k) {
                auto [low, high] = std::minmax({points[a][k], points[b][k], points[c][k]});
                centres[i][k] = 0.5 * (low + high);
            }
        }
    }

    // Append the tree of order[begin] to order[end - 1], halved along the longest side of the box of their centres.
    void add(std::int32_t begin, std::int32_t end) {
        Box box = EMPTY, of_centres = EMPTY;
        for (std::int32_t s = begin; s < end; ++s) {
            for (Node i : pieces[order[s]]) include(box, points[i]);
            include(of_centres, centres[order[s]]);
        }
        auto side = [&](int k) { return of_centres[k + 3] - of_centres[k]; };
        std::size_t at = links.size();
        boxes.insert(boxes.end(), box.begin(), box.end());
        links.insert(links.end(), {begin, end - begin});
        if (end - begin <= LEAF) return;
        int axis = 0;
        for (int k = 1; k < 3; ++k)
            if (side(k) > side(axis)) axis = k;
        std::int32_t middle = begin + (end - begin) / 2;
        std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end, [&](auto i, auto j) {
            return std::pair(centres[i][axis], i) < std::pair(centres[j][axis], j);
        });
        add(begin, middle);
        links[at] = static_cast<std::int32_t>(links.size() / 2), links[at + 1] = 0;
        add(middle, end);
    }
};

// Squared distance of x from a box.
double square_to(const Box &box, const Point &x) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        double distance = std::max({box[k] - x[k], 0.0, x[k] - box[k + 3]});
        sum += distance * distance;
    }
    return sum;
}

// Parameter t in [0, 1] of the point of the segment a + t d closest to a + p.
double along(const Vector &d, const Vector &p) {
    double whole = square(d);
    return whole > 0 ? std::clamp(dot(p, d) / whole, 0.0, 1.0) : 0.0;
}

// Barycentric coordinates of the point of the triangle (a, a + u, a + v) closest to a + p.
Barycentric nearest(const Vector &u, const Vector &v, const Vector &p) {
    Vector n = cross(u, v);
    double whole = square(n);
    if (whole > 0) {
        double second = dot(cross(p, v), n) / whole, third = dot(cross(u, p), n) / whole;
        if (second >= 0 && third >= 0 && second + third <= 1) return {1 - second - third, second, third};
    }
    // Outside the triangle, or a triangle without area: the closest point is on an edge.
    double one = along(u, p), two = along(v, p), three = along(v - u, p - u);
    Barycentric edges[3] = {{1 - one, one, 0}, {1 - two, 0, two}, {0, 1 - three, three}};
    double far[3] = {square(one * u - p), square(two * v - p), square(u + three * (v - u) - p)};
    return edges[std::min_element(far, far + 3) - far];
}

// Replace `best` if piece `number` is closer to x; of two that are as close, the first is best, but at distance 0 the
// search ends at either.
void improve(ClosestPoint &best, Points points, const Piece &piece, std::int32_t number, const Point &x) {
    Vector a = vector(points[piece[0]]), u = vector(points[piece[1]]) - a, p = vector(x) - a, place;
    Barycentric weights;
    if (piece[1] == piece[2]) {
        double t = along(u, p);
        weights = {1 - t, t, 0};
        place = t < 1 ? a + t * u : vector(points[piece[1]]);
    } else {
        Vector v = vector(points[piece[2]]) - a;
        weights = nearest(u, v, p);
        place = a + (weights[1] * u + weights[2] * v);
        for (int k = 0; k < 3; ++k)
            if (weights[k] == 1) place = vector(points[piece[k]]);  // exactly
    }
    double far = square(place - vector(x));
    if (far < best.square || (far == best.square && number < best.piece)) best = {far, number, point(place), weights};
}

}  // namespace

void expect_known(std::span<const std::int32_t> known, std::size_t pieces) {
    auto count = static_cast<std::int32_t>(pieces);
    for (std::int32_t piece : known) expect(piece < count, "piece: a number is out of range");
}

ClosestPoint BoxTrees::closest(const Point &x, std::int32_t root, double enough, std::int32_t known) const {
    ClosestPoint best;
    if (known >= 0) improve(best, points, pieces[known], known, x);
    std::pair<std::int32_t, double> waiting[DEEPEST];
    int size = 0;
    waiting[size++] = {root, square_to(boxes[root], x)};
    while (size && best.square > enough) {
        auto [at, square] = waiting[--size];
        if (square > best.square) continue;
        auto [link, count] = links[at];
        if (count) {
            for (std::int32_t i = link; i < link + count; ++i) improve(best, points, pieces[i], i, x);
            continue;
        }
        std::pair<std::int32_t, double> one{at + 1, square_to(boxes[at + 1], x)};
        std::pair<std::int32_t, double> other{link, square_to(boxes[link], x)};
        if (one.second < other.second) std::swap(one, other);
        if (one.second <= best.square) waiting[size++] = one;
        if (other.second <= best.square) waiting[size++] = other;  // the nearer is popped first
    }
    return best;
}

std::tuple<IntArray, OwnedArray<double, 6>, OwnedArray<std::int32_t, 2>, IntArray> build_trees(
    Points points, std::span<const Piece> pieces, Indices start) {
    TreeBuilder builder(points, pieces);
    std::vector<std::int32_t> roots;
    for (std::size_t t = 0; t + 1 < start.size(); ++t) {
        expect(start[t] >= 0 && start[t] < start[t + 1] && start[t + 1] <= static_cast<std::int64_t>(pieces.size()),
               "start does not ascend: expected at least one piece a tree");
        roots.push_back(static_cast<std::int32_t>(builder.links.size() / 2));
        builder.add(start[t], start[t + 1]);
    }
    return {{std::move(builder.order)}, {std::move(builder.boxes)}, {std::move(builder.links)}, {std::move(roots)}};
}

void refit(Points points, std::span<const Piece> pieces, std::span<const TreeLink> links, std::span<Box> boxes) {
    expect(links.size() == boxes.size(), "links and boxes have different lengths: expected a row a box");
    for (std::size_t at = links.size(); at-- > 0;) {  // children follow their parents
        auto [link, count] = links[at];
        Box &box = boxes[at];
        if (count == 0) {
            const Box &one = boxes[at + 1], &other = boxes[link];
            for (int k = 0; k < 3; ++k)
                box[k] = std::min(one[k], other[k]), box[k + 3] = std::max(one[k + 3], other[k + 3]);
            continue;
        }
        box = EMPTY;
        for (std::int32_t i = link; i < link + count; ++i)
            for (Node node : pieces[i]) include(box, points[node]);
    }
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
        Vector known =
            weights[i][0] * vector(points[a]) + weights[i][1] * vector(points[b]) + weights[i][2] * vector(points[c]);
        distances[i] = std::sqrt(square(known - vector(x[i])));
    });
}

void means(Points points, std::span<const std::array<Node, 4>> nodes, std::span<Point> x) {
    expect(x.size() == nodes.size(), "x: a row for each of nodes is expected");
    parallel_for(x.size(), POINTS_PER_CHUNK, [&](std::int64_t i) {
        Vector sum = vector(points[nodes[i][0]]);
        for (int k = 1; k < 4; ++k) sum = sum + vector(points[nodes[i][k]]);
        x[i] = point(0.25 * sum);
    });
}

}  // namespace hexmend
