#include "boundary/surface_fit.hpp"

#include <algorithm>

#include "boundary/four_pieces.hpp"
#include "boundary/near_points.hpp"
#include "simd/threads.hpp"

namespace hexmend {
namespace {

constexpr std::int64_t SAMPLES_PER_CHUNK = 128;
constexpr std::int64_t SLOTS_PER_CHUNK = 4096;
// Distance, in mean edge lengths, below which a vector has no direction of its own.
constexpr double NO_DIRECTION = 1e-3;

// The unit normal of a triangle, or tangent of a segment.
Point direction_of(Points points, const Piece &piece) {
    V3<double> a = vector(points[piece[0]]), b = vector(points[piece[1]]), c = vector(points[piece[2]]);
    return piece[1] == piece[2] ? unit(b - a) : unit(cross(b - a, c - a));
}

std::array<double, 6> outer(const V3<double> &v) {
    return {v.x * v.x, v.x * v.y, v.x * v.z, v.y * v.y, v.y * v.z, v.z * v.z};
}

// Second derivatives of the cost of sample i by its place, xx xy xz yy yz zz.
std::array<double, 6> block_of(const FitResult &result, const FitCosts &costs, std::size_t i) {
    const double d = result.distances[i], first = costs.first[i], second = costs.second[i];
    const V3<double> direction = vector(result.directions[i]);
    const V3<double> along = (d > NO_DIRECTION ? 1 / d : 0.0) * vector(result.vectors[i]);
    if (!costs.of_line[i]) {
        auto block = outer(d > NO_DIRECTION ? along : direction);
        for (double &value : block) value *= second;
        return block;
    }
    const auto with = outer(along), without = outer(direction);
    std::array<double, 6> block{first, 0, 0, first, 0, first};
    for (int k = 0; k < 6; ++k) block[k] += (second - first) * with[k] - first * without[k];
    return block;
}

}  // namespace

void fit_distances(const FitSamples &samples, const BoxTrees &moving, Indices rows, std::span<std::int32_t> known,
                   const FitResult &result) {
    const std::size_t count = samples.nodes.size();
    const std::size_t all = count + known.size();
    expect(known.size() <= count, "known: expected a row for each sample of the surface, no more than samples");
    expect(
        have_rows(all, result.distances, result.vectors, result.directions, result.nodes, result.weights),
        "distances, vectors, directions, nodes and weights: expected a row a sample of the boundary and the surface");
    expect_known(known, moving.pieces.size());
    for (auto row : rows) expect(row >= 0 && static_cast<std::size_t>(row) < all, "rows: expected numbers of samples");
    const auto nodes = static_cast<std::int64_t>(moving.points.size() - samples.faces.size());
    auto put = [&](std::size_t row, const V3<double> &r, const Point &direction) {
        result.distances[row] = length(r), result.vectors[row] = point(r), result.directions[row] = direction;
    };
    auto forward = [&](std::size_t i) {
        const V3<double> here = mean_of(moving.points, samples.nodes[i]);
        result.nodes[i] = samples.nodes[i], result.weights[i] = {0.25, 0.25, 0.25, 0.25};
        if (samples.slots[i] < 0) return put(i, here - vector(samples.first[i]), {});
        ClosestPoint found = samples.surface->closest(samples.slots[i], point(here));
        if (found.piece < 0) return put(i, {INF, INF, INF}, {});  // not finite
        put(i, here - vector(found.place), samples.directions[found.piece]);
    };
    auto backward = [&](std::size_t row) {
        const std::size_t i = row - count;
        result.nodes[row] = samples.nodes[i], result.weights[row] = {};
        if (samples.slots[i] < 0) return put(row, {}, {});
        ClosestPoint found = moving.closest(samples.first[i], samples.roots[i], 0, known[i]);
        if (found.piece < 0) return put(row, {INF, INF, INF}, {});
        known[i] = found.piece;
        const Piece &piece = moving.pieces[found.piece];
        put(row, vector(found.place) - vector(samples.first[i]), direction_of(moving.points, piece));
        const auto &[a, b, c] = found.weights;
        if (piece[1] == piece[2]) {
            result.nodes[row] = {piece[0], piece[1], piece[0], piece[0]};
            result.weights[row] = {a, b + c, 0, 0};
            return;
        }
        const std::array<Node, 4> &face = samples.faces[piece[2] - nodes];
        SampleWeights weights{c / 4, c / 4, c / 4, c / 4};
        for (int k = 0; k < 4; ++k) weights[k] += (face[k] == piece[0] ? a : 0.0) + (face[k] == piece[1] ? b : 0.0);
        result.nodes[row] = face, result.weights[row] = weights;
    };
    parallel_for(static_cast<std::int64_t>(rows.size()), SAMPLES_PER_CHUNK, [&](std::int64_t at) {
        const auto row = static_cast<std::size_t>(rows[at]);
        row < count ? forward(row) : backward(row);
    });
}

void fit_gradient(std::span<const SampleNodes> nodes, std::span<const SampleWeights> weights, Points vectors,
                  std::span<Point> gradient) {
    expect(have_rows(nodes.size(), weights, vectors), "nodes, weights and vectors have different lengths");
    for (std::size_t i = 0; i < nodes.size(); ++i)
        for (int k = 0; k < 4; ++k)
            for (int x = 0; x < 3; ++x) gradient[nodes[i][k]][x] += weights[i][k] * vectors[i][x];
}

template <class Real>
void fit_hessian(std::span<const SampleNodes> slots, const FitResult &result, const FitCosts &costs, Indices row_start,
                 Indices columns, std::span<std::array<Real, 9>> off_diagonal,
                 std::span<std::array<Real, 6>> diagonal) {
    expect(have_rows(slots.size(), result.distances, result.vectors, result.directions, result.weights, costs.first,
                     costs.second, costs.of_line),
           "slots, samples and costs have different lengths");
    expect(row_start.size() == diagonal.size() + 1 && off_diagonal.size() > columns.size() &&
               static_cast<std::size_t>(row_start[diagonal.size()]) <= columns.size(),
           "row_start: expected one more than rows of diagonal; off_diagonal: more rows than columns");
    constexpr int places[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
    parallel_chunks(
        static_cast<std::int64_t>(diagonal.size()), SLOTS_PER_CHUNK, [&](std::int64_t low, std::int64_t high) {
            for (std::size_t i = 0; i < slots.size(); ++i) {
                if (costs.second[i] == 0) continue;
                std::array<double, 6> block{};
                bool is_known = false;
                for (int a = 0; a < 4; ++a) {
                    const Node row = slots[i][a];
                    const double own = result.weights[i][a];
                    if (row < low || row >= high || own == 0) continue;
                    if (!is_known) block = block_of(result, costs, i), is_known = true;
                    for (int b = 0; b < 4; ++b) {
                        const Node column = slots[i][b];
                        const double weight = own * result.weights[i][b];
                        if (column < row || weight == 0) continue;
                        if (column == row) {
                            for (int k = 0; k < 6; ++k) diagonal[row][k] += static_cast<Real>(weight * block[k]);
                            continue;
                        }
                        const auto *begin = &columns[row_start[row]], *end = &columns[0] + row_start[row + 1];
                        const auto *at = std::find(begin, end, column);
                        if (at == end) continue;  // nodes of a degenerate quad
                        auto &added = off_diagonal[at - &columns[0]];
                        for (int k = 0; k < 9; ++k) added[k] += static_cast<Real>(weight * block[places[k]]);
                    }
                }
            }
        });
}

template void fit_hessian<float>(std::span<const SampleNodes>, const FitResult &, const FitCosts &, Indices, Indices,
                                 std::span<std::array<float, 9>>, std::span<std::array<float, 6>>);
template void fit_hessian<double>(std::span<const SampleNodes>, const FitResult &, const FitCosts &, Indices, Indices,
                                  std::span<std::array<double, 9>>, std::span<std::array<double, 6>>);

}  // namespace hexmend
