#include "mesh/incidence.hpp"

#include "mesh/csr.hpp"
#include "mesh/hex_mesh.hpp"

namespace hexmend {
namespace {

// An edge in the row of its lower node.
struct Edge {
    Node end;
    std::int32_t valence, last;  // number of hexes around it, and the hex that was counted last
    bool outside;
};

}  // namespace

std::tuple<OwnedArray<Node, 2>, IntArray, OwnedArray<bool>> edges(Hexes hexes, Indices start, Indices corners,
                                                                  Neighbours neighbours, std::int64_t max_items) {
    expect_corners(hexes.size(), start, corners);
    expect(neighbours.size() == hexes.size(), "neighbours: a row for each of hexes is expected");
    CSRBuilder<Edge> rows(start.size() - 1, 4 * widest(start) + 1, max_items, [&](std::int64_t i, Edge *row) {
        int size = 0;
        for (auto s = start[i]; s < start[i + 1]; ++s) {
            int h = corners[s] / 8, c = corners[s] % 8;
            auto &sides = edges_at(hexes[h], c);
            for (int k = 0; k < sides.count; ++k) {
                Node j = hexes[h][sides.ends[k]];
                if (j <= i) continue;
                Edge *edge = placed(row, size, {j, 0, -1, false}, [](const Edge &e) { return e.end; });
                edge->valence += edge->last != h;
                edge->last = h;
                edge->outside |= neighbours[h][sides.faces[k][0]] < 0 || neighbours[h][sides.faces[k][1]] < 0;
            }
        }
        return size;
    });
    std::vector<Node> ends(2 * rows.size());
    std::vector<std::int32_t> valence(rows.size());
    std::vector<std::uint8_t> outside(rows.size());
    rows.each([&](std::int64_t i, std::int64_t k, const Edge &edge) {
        ends[2 * k] = i, ends[2 * k + 1] = edge.end;
        valence[k] = edge.valence;
        outside[k] = edge.outside;
    });
    return {{std::move(ends)}, {std::move(valence)}, {std::move(outside)}};
}

void average_along_sheets(EdgeGroups groups, Numbers values, std::span<double> average, std::span<std::int32_t> count) {
    auto fits = [&](std::int32_t edge) { return edge >= 0 && std::size_t(edge) < values.size(); };
    bool all = std::ranges::all_of(groups, [&](const auto &group) { return std::ranges::all_of(group, fits); });
    expect(!values.empty() && all, "groups must hold numbers of edges, or the number of edges for none");
    expect(average.size() == values.size() && count.size() == values.size(), "average and count must be as values");
    const auto none = std::int32_t(values.size() - 1);
    std::ranges::fill(average, 0.0);
    std::ranges::fill(count, 0);
    for (const auto &group : groups) {
        double sum = 0;
        int size = 0;
        for (auto edge : group)
            if (edge != none) sum += values[edge], ++size;
        if (!size) continue;
        for (auto edge : group) average[edge] += sum / size, ++count[edge];
    }
    for (std::size_t i = 0; i < average.size(); ++i) average[i] /= std::max(count[i], 1);
    average[none] = 0, count[none] = 0;
}

}  // namespace hexmend
