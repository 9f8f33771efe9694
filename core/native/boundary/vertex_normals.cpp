#include "boundary/vertex_normals.hpp"

#include "mesh/csr.hpp"
#include "simd/vectors.hpp"

namespace hexmend {
namespace {

Point unit(const V3<double> &v) {
    const double size = length(v);
    return size > 0 ? point((1 / size) * v) : Point{};
}

// No product is fused with a sum, so that the product of parallel sides is 0.
V3<double> exact_cross(const V3<double> &a, const V3<double> &b) {
    return {uncontracted(a.y * b.z) - uncontracted(a.z * b.y), uncontracted(a.z * b.x) - uncontracted(a.x * b.z),
            uncontracted(a.x * b.y) - uncontracted(a.y * b.x)};
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

// Corners (3 t + c) of triangles at each vertex, ascending.
std::pair<std::vector<std::int32_t>, std::vector<std::int32_t>> corners_at_vertices(std::span<const Piece> triangles,
                                                                                    std::size_t vertices) {
    std::vector<std::int32_t> start(vertices + 1), corners(3 * triangles.size());
    for (const Piece &triangle : triangles)
        for (Node vertex : triangle) ++start[vertex + 1];
    accumulate(start);
    std::vector<std::int32_t> next(start.begin(), start.end() - 1);
    for (std::size_t i = 0; i < corners.size(); ++i) corners[next[triangles[i / 3][i % 3]]++] = i;
    return {std::move(start), std::move(corners)};
}

}  // namespace

void vertex_normals(Points points, std::span<const Piece> triangles, Indices patch, std::span<Point> normals) {
    expect(patch.size() == triangles.size(), "patch: one for each of the triangles is expected");
    expect(normals.size() == 3 * triangles.size(), "normals: three rows for each of the triangles are expected");
    std::vector<V3<double>> weighted(normals.size());
    parallel_for(triangles.size(), ROWS_PER_CHUNK, [&](std::int64_t t) {
        auto own = weighted_normals(points, triangles[t]);
        std::copy(own.begin(), own.end(), &weighted[3 * t]);
    });
    const auto [start, corners] = corners_at_vertices(triangles, points.size());
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
