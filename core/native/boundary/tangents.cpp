#include "boundary/tangents.hpp"

#include <cmath>
#include <limits>

#include "mesh/csr.hpp"
#include "simd/vectors.hpp"

namespace hexmend {
namespace {

constexpr std::int64_t NODES_PER_CHUNK = 1024;

// Interpolated directions shorter than this are rounding: those at the corners are opposed. As ROUNDING in Python.
constexpr double LEAST_MEAN = 1e-7;

V3<double> over(const V3<double> &a, double size) { return {a.x / size, a.y / size, a.z / size}; }

// The mean of the directions at the corners of a piece; that of the piece where it has none.
V3<double> interpolated(const std::array<double, 9> &corners, const Barycentric &weights, const V3<double> &flat) {
    double mean[3] = {};
    for (int corner = 0; corner < 3; ++corner)
        for (int k = 0; k < 3; ++k) mean[k] += uncontracted(weights[corner] * corners[3 * corner + k]);
    V3<double> along{mean[0], mean[1], mean[2]};
    double size = std::sqrt(exact_dot(along, along));
    return size > LEAST_MEAN ? over(along, size) : flat;
}

// A unit vector at right angles to a normal, and to the axis that is most across it.
V3<double> across(const V3<double> &normal) {
    const double sides[3] = {std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    int axis = 0;
    for (int k = 1; k < 3; ++k)
        if (sides[k] < sides[axis]) axis = k;
    V3<double> first = exact_cross(normal, {double(axis == 0), double(axis == 1), double(axis == 2)});
    return over(first, std::max(std::sqrt(exact_dot(first, first)), std::numeric_limits<double>::min()));
}

// Unit normals of a triangle, times its angle at each corner.
std::array<V3<double>, 3> weighted_normals(Points points, const Piece &triangle) {
    V3<double> x[3], sides[3];
    for (int c = 0; c < 3; ++c) x[c] = vector(points[triangle[c]]);
    for (int c = 0; c < 3; ++c) sides[c] = x[(c + 1) % 3] - x[c];
    const V3<double> area = exact_cross(sides[0], sides[1]), normal = vector(unit(area));
    std::array<V3<double>, 3> weighted;
    for (int c = 0; c < 3; ++c) weighted[c] = std::atan2(length(area), -dot(sides[c], sides[(c + 2) % 3])) * normal;
    return weighted;
}

}  // namespace

void tangent_bases(const SurfaceDirections &surface, Indices pieces, std::span<const Barycentric> weights,
                   std::span<const bool> of_curve, double interior, ArrayView<double, 9> bases) {
    expect(weights.size() == pieces.size() && of_curve.size() == pieces.size() && bases.size() == pieces.size(),
           "pieces, weights, of_curve and bases have different lengths: expected a row a node");
    parallel_for(pieces.size(), NODES_PER_CHUNK, [&](std::int64_t i) {
        const std::int64_t number = surface.number[pieces[i]];
        const Barycentric &weight = weights[i];
        const bool curve = of_curve[i];  // a segment has two weights
        const bool inside = weight[0] > interior && weight[1] > interior && (curve || weight[2] > interior);
        V3<double> along = vector(surface.flat[number]);
        if (!inside) along = interpolated(surface.smooth[number], weight, along);
        const V3<double> first = curve ? along : across(along);
        const V3<double> second = curve ? V3<double>{} : exact_cross(along, first);
        bases[i] = {first.x, second.x, 0, first.y, second.y, 0, first.z, second.z, 0};
    });
}

void tangent_projectors(ArrayView<const double, 9> bases, ArrayView<double, 9> projectors) {
    expect(projectors.size() == bases.size(), "projectors: a row for each of bases is expected");
    parallel_for(bases.size(), NODES_PER_CHUNK, [&](std::int64_t i) {
        const std::array<double, 9> &b = bases[i];
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column <= row; ++column) {
                double sum = uncontracted(b[3 * row] * b[3 * column]);
                for (int k = 1; k < 3; ++k) sum += b[3 * row + k] * b[3 * column + k];
                projectors[i][3 * row + column] = projectors[i][3 * column + row] = sum;
            }
    });
}

void vertex_normals(Points points, std::span<const Piece> triangles, Indices patch, std::span<Point> normals) {
    expect(patch.size() == triangles.size(), "patch: one for each of the triangles is expected");
    expect(normals.size() == 3 * triangles.size(), "normals: three rows for each of the triangles are expected");
    std::vector<V3<double>> weighted(normals.size());
    parallel_for(triangles.size(), ROWS_PER_CHUNK, [&](std::int64_t t) {
        auto own = weighted_normals(points, triangles[t]);
        std::copy(own.begin(), own.end(), &weighted[3 * t]);
    });
    const auto [start, corners] =
        group_by(points.size(), normals.size(), [&](std::int64_t i) { return triangles[i / 3][i % 3]; });
    const auto *begin = start.data(), *items = corners.data();
    parallel_for(points.size(), ROWS_PER_CHUNK, [&, begin, items](std::int64_t vertex) {
        const Indices at(items + begin[vertex], items + begin[vertex + 1]);
        for (std::size_t i = 0; i < at.size(); ++i) {
            const std::int32_t own = patch[at[i] / 3];
            std::size_t first = 0;
            while (patch[at[first] / 3] != own) ++first;
            if (first < i) {
                normals[at[i]] = normals[at[first]];
                continue;
            }
            V3<double> sum{};
            for (std::int32_t corner : at)
                if (patch[corner / 3] == own) sum += weighted[corner];
            normals[at[i]] = unit(sum);
        }
    });
}

}  // namespace hexmend
