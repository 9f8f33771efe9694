#include "boundary/surface_points.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "mesh/csr.hpp"
#include "mesh/incidence.hpp"

namespace hexmend {
namespace {

// Slots of the hash table for each point, at least.
constexpr std::size_t SLOTS_PER_POINT = 2;

std::uint64_t hash(const Point &x) {
    std::uint64_t h = 0;
    for (double coordinate : x) {
        h ^= std::bit_cast<std::uint64_t>(coordinate + 0.0);  // of 0 and -0
        h *= 0x9E3779B97F4A7C15u;
        h ^= h >> 29;
    }
    return h;
}

// The side that follows another of its face.
std::int32_t next_side(std::int32_t side, int width) { return side % width + 1 < width ? side + 1 : side + 1 - width; }

}  // namespace

IntArray numbers_of_different_points(Points points) {
    const std::size_t slots = std::bit_ceil(SLOTS_PER_POINT * points.size() + 1);
    std::vector<std::int32_t> table(slots);  // one more than the number of a different point, 0 for none
    std::vector<std::int32_t> numbers(points.size()), first;
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::size_t slot = hash(points[i]) & (slots - 1);
        while (table[slot] && points[first[table[slot] - 1]] != points[i]) slot = (slot + 1) & (slots - 1);
        if (!table[slot]) {
            first.push_back(static_cast<std::int32_t>(i));
            table[slot] = static_cast<std::int32_t>(first.size());
        }
        numbers[i] = table[slot] - 1;
    }
    return {std::move(numbers)};
}

std::tuple<OwnedArray<std::int32_t, 2>, IntArray, IntArray> edges_of_faces(Indices faces, int width,
                                                                           std::int64_t nodes) {
    expect(nodes >= 0, "nodes: the number of nodes is expected");
    expect(width > 0 && faces.size() % width == 0, "faces: `width` nodes of each are expected");
    for (Node node : faces) expect(node >= 0 && node < nodes, "faces: a node is out of range");
    auto ends = [&](std::int32_t side) { return std::minmax({faces[side], faces[next_side(side, width)]}); };
    auto rows = group_by(nodes, faces.size(), [&](std::int64_t side) {
        auto [low, high] = ends(static_cast<std::int32_t>(side));
        return low < high ? low : -1;
    });
    auto &[start, sides] = rows;  // at the lower node of each
    parallel_for(nodes, ROWS_PER_CHUNK, [&rows, &ends](std::int64_t i) {
        auto begin = rows.second.begin();
        std::sort(begin + rows.first[i], begin + rows.first[i + 1], [&](std::int32_t a, std::int32_t b) {
            return std::pair(ends(a).second, a) < std::pair(ends(b).second, b);
        });
    });
    std::vector<std::int32_t> edges, first;
    edges.reserve(sides.size() + 2), first.reserve(sides.size() / 2 + 1);  // most have two sides
    for (std::int64_t node = 0; node < nodes; ++node) {
        for (std::int32_t k = start[node], last = -1; k < start[node + 1]; ++k) {
            const Node high = ends(sides[k]).second;
            if (std::exchange(last, high) == high) continue;
            edges.push_back(static_cast<std::int32_t>(node)), edges.push_back(high);
            first.push_back(k);
        }
    }
    first.push_back(static_cast<std::int32_t>(sides.size()));
    return {{std::move(edges)}, {std::move(sides)}, {std::move(first)}};
}

IntArray count_fans(Indices faces, int width, Indices sides, Indices first, std::int64_t nodes) {
    expect(width > 0 && faces.size() % width == 0, "faces: `width` nodes of each are expected");
    expect(are_csr(first, sides.size()), "first: its last number is expected to be the length of sides");
    expect(sides.size() <= faces.size(), "sides: each side of faces once at most is expected");
    expect(nodes >= 0, "nodes: the number of nodes is expected");
    std::vector<std::int32_t> parent(faces.size()), count(nodes);  // corners of faces that are of one fan are joined
    std::iota(parent.begin(), parent.end(), 0);
    auto join_corners = [&](std::int32_t one, std::int32_t other) { join(parent, std::array{one, other}, 2); };
    auto next = [&](std::int32_t corner) { return next_side(corner, width); };
    for (std::size_t e = 0; e + 1 < first.size(); ++e) {
        for (std::int32_t k = first[e] + 1; k < first[e + 1]; ++k) {
            const std::int32_t one = sides[k - 1], other = sides[k];
            const bool opposed = faces[one] != faces[other];
            join_corners(one, opposed ? next(other) : other);
            join_corners(next(one), opposed ? other : next(other));
        }
    }
    // Successive corners of a face that are one node are of one fan.
    for (std::int32_t corner = 0; corner < static_cast<std::int32_t>(faces.size()); ++corner)
        if (faces[corner] == faces[next(corner)]) join_corners(corner, next(corner));
    for (std::size_t corner = 0; corner < faces.size(); ++corner)
        count[faces[corner]] += parent[corner] == static_cast<std::int32_t>(corner);
    return {std::move(count)};
}

OwnedArray<double> quantiles_around(ArrayView<const Node, 2> edges, Indices start, Indices ends, Numbers values,
                                    Indices some, double most, double share) {
    expect(values.size() == edges.size(), "values: one for each edge is expected");
    expect(are_csr(start, ends.size()), "start: its last number is expected to be the length of ends");
    std::vector<double> quantiles(some.size());
    parallel_chunks(some.size(), ROWS_PER_CHUNK, [&](std::int64_t begin, std::int64_t end) {
        std::vector<std::int32_t> seen(edges.size(), -1);  // the last row around which an edge was found
        std::vector<double> around;
        for (std::int64_t row = begin; row < end; ++row) {
            around.clear();
            auto each_end = [&](Node i, const auto &body) {
                for (auto k = start[i]; k < start[i + 1]; ++k) body(ends[k]);
            };
            auto add = [&](std::int32_t at) {
                const std::int32_t e = at / 2;
                if (seen[e] == row) return;
                seen[e] = static_cast<std::int32_t>(row);
                if (values[e] <= most) around.push_back(values[e]);
            };
            seen[some[row]] = static_cast<std::int32_t>(row);
            for (Node i : edges[some[row]])
                each_end(i, [&](std::int32_t at) { each_end(edges[at / 2][1 - at % 2], add); });
            if (around.empty()) continue;
            auto place = around.begin() + static_cast<std::int64_t>(share * around.size());
            std::nth_element(around.begin(), place, around.end());
            quantiles[row] = *place;
        }
    });
    return {std::move(quantiles)};
}

}  // namespace hexmend
