
#include "view/view.hpp"

#include <algorithm>
#include <utility>

namespace hexmend {

Faces visible(std::int64_t nodes, Hexes hexes, Neighbours neighbours, HexMask keep) {
    expect(nodes >= 0, "nodes: the number of nodes is expected");
    expect(have_rows(hexes.size(), neighbours, keep), "neighbours and keep: a row for each of hexes is expected");
    OwnedArray<Node> used, owners;
    OwnedArray<Node, 4> quads;
    std::vector<Node> place(nodes, -1);  // position of a node among those used
    for (std::size_t h = 0; h < hexes.size(); ++h) {
        if (!keep[h]) continue;
        const auto &table = table_of(hexes[h]);
        for (int f = 0; f < table.faces; ++f) {
            Node behind = neighbours[h][f];
            if (behind >= 0 && keep[behind]) continue;
            std::array<Node, 4> quad;
            for (int k = 0; k < 4; ++k) {
                Node node = hexes[h][table.face_nodes[f][k]];
                if (place[node] < 0) {
                    place[node] = static_cast<Node>(used.values.size());
                    used.values.push_back(node);
                }
                quad[k] = place[node];
            }
            quads.values.insert(quads.values.end(), quad.begin(), quad.end());
            owners.values.push_back(static_cast<Node>(h));
        }
    }
    return {std::move(used), std::move(quads), std::move(owners)};
}

void edges_kept(Hexes hexes, Indices start, Indices corners, ArrayView<const Node, 2> edges, HexMask keep,
                std::span<bool> answer) {
    expect_corners(hexes.size(), start, corners);
    expect(keep.size() == hexes.size(), "keep: one for each of hexes is expected");
    expect(answer.size() == edges.size(), "answer: one for each of edges is expected");
    for (std::size_t e = 0; e < edges.size(); ++e) {
        auto [one, other] = edges[e];
        answer[e] = std::any_of(corners.begin() + start[one], corners.begin() + start[one + 1], [&](Node corner) {
            const Hex &hex = hexes[corner / 8];
            return keep[corner / 8] && std::find(hex.begin(), hex.end(), other) != hex.end();
        });
    }
}

}  // namespace hexmend
