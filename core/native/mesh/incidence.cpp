#include "mesh/incidence.hpp"

#include <numeric>

#include "mesh/colouring.hpp"
#include "mesh/hex_mesh.hpp"

namespace hexmend {

CSR node_corners(Hexes hexes, std::int64_t nodes) {
    expect(nodes >= 0, "n: the number of nodes is expected");
    auto [start, corners] = group_by(nodes, 8 * hexes.size(), [&](std::int64_t k) {
        const Hex &cell = hexes[k / 8];
        return k % 8 < table_of(cell).nodes ? cell[k % 8] : Node{-1};
    });
    return {{std::move(start)}, {std::move(corners)}};
}

namespace {

// A face seen from one of its corners: the three other corners, which of them follow it in the face, and, as seen from
// outside, the corner after it, that across the face, and that before it. In a triangle the corner itself is across.
struct FaceAtNode {
    int face, corner[3], after[3], around[3];
    bool triangle;
};
struct FacesAtNode {
    int count = 0;
    FaceAtNode faces[4] = {};
};

constexpr auto FACES_AT_NODE = [] {
    std::array<std::array<FacesAtNode, 8>, CELL_KINDS> all{};
    for (int kind = 0; kind < CELL_KINDS; ++kind) {
        auto &table = CELL_TABLES[kind];
        auto add = [&](int node, int f) {
            auto &nodes = table.face_nodes[f];
            const int corners = nodes[2] == nodes[3] ? 3 : 4;
            int at = 0;
            while (at < corners && nodes[at] != node) ++at;
            if (at == corners) return;
            auto &to = all[kind][node].faces[all[kind][node].count++];
            to.face = f, to.triangle = corners == 3;
            int size = 0;
            for (int k = 0; k < corners; ++k)
                if (k != at) to.corner[size] = nodes[k], to.after[size++] = k > at;
            if (corners == 3) to.corner[2] = node, to.after[2] = 1;
            to.around[0] = nodes[(at + 1) % corners], to.around[2] = nodes[(at + corners - 1) % corners];
            to.around[1] = corners == 3 ? node : nodes[(at + 2) % 4];
        };
        for (int node = 0; node < table.nodes; ++node) {
            if (kind == HEXAHEDRON)
                for (int f : CORNER_FACES[node]) add(node, f);
            else
                for (int f = 0; f < table.faces; ++f) add(node, f);
        }
    }
    return all;
}();

inline std::span<const FaceAtNode> faces_at(const Hex &cell, int node) {
    auto &at = FACES_AT_NODE[kind_of(cell)][node];
    return {at.faces, static_cast<std::size_t>(at.count)};
}

// A face in the list of its lowest node: the other three nodes, ascending; the number of faces on the same nodes, and
// the last of them.
struct Face {
    Node a, b, c;
    std::int32_t number, matches, other;

    void match(Face &face) {
        if (a != face.a || b != face.b || c != face.c) return;
        ++matches, ++face.matches;
        other = face.number, face.other = number;
    }
};

// True if two faces, given as 6 * cell + face, have their nodes in opposite order: their cells are on opposite sides.
bool are_opposed(Hexes hexes, int one, int other) {
    auto corners = [&](int face) {
        auto &nodes = table_of(hexes[face / 6]).face_nodes[face % 6];
        return nodes[2] == nodes[3] ? 3 : 4;
    };
    auto node = [&](int face, int k) { return hexes[face / 6][table_of(hexes[face / 6]).face_nodes[face % 6][k]]; };
    const int count = corners(one);
    if (corners(other) != count) return false;
    for (int last = count - 1; last < 2 * count - 1; ++last) {
        int k = 0;
        while (k < count && node(one, k) == node(other, (last - k) % count)) ++k;
        if (k == count) return true;
    }
    return false;
}

}  // namespace

std::pair<OwnedArray<std::int32_t, 6>, std::int64_t> face_neighbours(Hexes hexes, Indices start, Indices corners,
                                                                     bool opposed) {
    expect_corners(hexes.size(), start, corners);
    std::vector<std::int32_t> neighbours(6 * hexes.size());
    for (std::size_t h = 0; h < hexes.size(); ++h)  // of faces that a cell does not have: itself
        for (int f = table_of(hexes[h]).faces; f < 6; ++f) neighbours[6 * h + f] = h;
    const std::int64_t nodes = start.size() - 1;
    std::vector<std::int64_t> overlapping((nodes + ROWS_PER_CHUNK - 1) / ROWS_PER_CHUNK);
    parallel_chunks(nodes, ROWS_PER_CHUNK, [&](std::int64_t begin, std::int64_t end) {
        std::vector<Face> faces;  // whose lowest node is i: about six
        for (std::int64_t i = begin; i < end; ++i) {
            faces.clear();
            for (auto s = start[i]; s < start[i + 1]; ++s) {
                int h = corners[s] / 8;
                for (auto &[f, corner, after, around, triangle] : faces_at(hexes[h], corners[s] % 8)) {
                    Node a = hexes[h][corner[0]], b = hexes[h][corner[1]], c = hexes[h][corner[2]];
                    // Where two corners are one node, the first of them represents the face.
                    if (!((a + after[0] > i) & (b + after[1] > i) & (c + after[2] > i))) continue;
                    if (a > b) std::swap(a, b);
                    if (b > c) std::swap(b, c);
                    if (a > b) std::swap(a, b);
                    if (triangle) a = -1;  // in the place of its lowest node itself
                    faces.push_back({a, b, c, 6 * h + f, 0, -1});
                }
            }
            for (std::size_t s = 0; s < faces.size(); ++s)
                for (std::size_t t = 0; t < s; ++t) faces[s].match(faces[t]);
            for (const Face &face : faces) {
                const bool inner = face.matches == 1 && (!opposed || are_opposed(hexes, face.number, face.other));
                neighbours[face.number] = inner ? face.other / 6 : -1;
                overlapping[begin / ROWS_PER_CHUNK] += face.matches > 0 && !inner;
            }
        }
    });
    return {{std::move(neighbours)}, std::reduce(overlapping.begin(), overlapping.end())};
}

CSR overlapping_corners(Hexes hexes, Indices start, Indices corners) {
    expect_corners(hexes.size(), start, corners);
    struct Side {  // a face at a corner: its two edges there as one number, the node across it, the corner
        std::int64_t edges;
        Node across;
        std::int32_t corner;
    };
    return arrays(CSRBuilder<std::int32_t>(start.size() - 1, widest(start), MOST_ITEMS, [&](std::int64_t i, int *row) {
        thread_local std::vector<Side> sides;
        sides.clear();
        int size = 0;
        for (auto s = start[i]; s < start[i + 1]; ++s)
            for (auto &at : faces_at(hexes[corners[s] / 8], corners[s] % 8)) {
                auto [after, across, before] = at.around;
                const Hex &hex = hexes[corners[s] / 8];
                Node a = hex[after], b = hex[before];
                if (a == b || a == i || b == i) continue;
                Side side{static_cast<std::int64_t>(a) << 32 | b, hex[across], corners[s]};
                for (const Side &other : sides)
                    if (side.edges == other.edges && side.across != other.across) {
                        placed(row, size, side.corner);
                        placed(row, size, other.corner);
                    }
                sides.push_back(side);
            }
        return size;
    }));
}

void join(std::span<std::int32_t> parent, Indices items, int width) {
    auto root = [&](std::int32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (std::size_t row = 0; row + width <= items.size(); row += width) {
        auto first = root(items[row]);
        for (int k = 1; k < width; ++k) {
            if (parent[items[row + k]] == first) continue;
            auto other = root(items[row + k]);
            parent[std::max(first, other)] = std::min(first, other);
            first = std::min(first, other);
        }
    }
}

// One more than the greatest cell of corners.
static std::size_t count_cells(Indices corners) {
    auto last = std::max_element(corners.begin(), corners.end());
    return last == corners.end() ? 0 : *last / 8 + 1;
}

CSR node_rings(Hexes hexes, Indices start, Indices corners, std::int64_t max_items) {
    expect_corners(hexes.size(), start, corners);
    const HexMesh mesh{hexes, start, corners};
    return arrays(CSRBuilder<Node>(mesh.nodes(), 4 * mesh.largest_star() + 1, max_items,
                                   [&](std::int64_t i, Node *ring) { return mesh.ring(i, ring); }));
}

IntArray greedy_colours(Indices start, Indices corners, std::span<const bool> chosen) {
    expect(are_csr(start, corners.size()), "start: its last number is expected to be the length of corners");
    expect(chosen.size() + 1 == start.size(), "chosen: one for each node is expected");
    auto each_hex = [&](std::int64_t i, const auto &body) {
        for (auto s = start[i]; s < start[i + 1]; ++s) body(corners[s] / 8);
    };
    return {greedy_colouring(chosen.size(), count_cells(corners), [&](std::int64_t i) { return chosen[i]; }, each_hex)};
}

CSR grouped(Indices colour, std::int64_t count) {
    expect(count >= 0, "count: the number of colours is expected");
    auto [start, nodes] = group_by(count, colour.size(), [&](std::int64_t i) { return colour[i]; });
    return {{std::move(start)}, {std::move(nodes)}};
}

IntArray levels(Indices ring_start, Indices ring, std::span<const bool> from) {
    expect_rings(from.size(), ring_start, ring);
    std::vector<std::int32_t> level(from.size(), -1), queue;
    queue.reserve(from.size());
    for (std::size_t i = 0; i < from.size(); ++i)
        if (from[i]) level[i] = 0, queue.push_back(i);
    std::int32_t deepest = -1;
    for (std::size_t at = 0; at < queue.size(); ++at) {
        const auto i = queue[at];
        deepest = level[i];
        for (auto s = ring_start[i]; s < ring_start[i + 1]; ++s)
            if (auto j = ring[s]; level[j] < 0) level[j] = deepest + 1, queue.push_back(j);
    }
    std::replace(level.begin(), level.end(), -1, deepest + 1);
    return {std::move(level)};
}

CSR wavefronts(Indices start, Indices corners, Indices sequence) {
    expect(are_csr(start, corners.size()), "start: its last number is expected to be the length of corners");
    std::vector<std::int32_t> next(count_cells(corners));  // of each hex: one more than the group of its latest node
    std::vector<std::int32_t> group(sequence.size());
    std::int32_t groups = 0;
    for (std::size_t k = 0; k < sequence.size(); ++k) {
        const Node i = sequence[k];
        for (auto s = start[i]; s < start[i + 1]; ++s) group[k] = std::max(group[k], next[corners[s] / 8]);
        for (auto s = start[i]; s < start[i + 1]; ++s) next[corners[s] / 8] = group[k] + 1;
        groups = std::max(groups, group[k] + 1);
    }
    auto [group_start, nodes] = group_by(groups, sequence.size(), [&](std::int64_t k) { return group[k]; });
    for (auto &node : nodes) node = sequence[node];
    return {{std::move(group_start)}, {std::move(nodes)}};
}

}  // namespace hexmend
