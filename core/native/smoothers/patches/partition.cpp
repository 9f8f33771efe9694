#include "smoothers/patches/patches.hpp"

#include <algorithm>

#include "mesh/colouring.hpp"

namespace hexmend {

std::tuple<IntArray, IntArray, IntArray, IntArray, OwnedArray<std::int32_t, 8>> partition(const HexMesh &mesh,
                                                                                          std::span<const bool> free,
                                                                                          std::int64_t size,
                                                                                          int overlap) {
    expect(free.size() == mesh.nodes(), "free: one for each node is expected");
    expect(size > 0 && overlap >= 0, "size and overlap: a node at least, and no negative number, are expected");
    const Hexes hexes = mesh.hexes;
    const std::int64_t n = free.size();
    std::vector<std::int32_t> node_start(1), nodes, hex_start(1), patch_hexes;
    std::vector<std::int32_t> slots;
    std::vector<std::uint8_t> taken(n);  // by a patch, not counting overlaps
    std::vector<std::int32_t> slot(n, -1), used(hexes.size(), -1);
    std::vector<Node> patch;

    auto for_each_neighbour = [&](Node i, auto body) {  // body(j) for the free nodes j that share a hex with node i
        for (auto corner : mesh.star(i))
            for (Node j : hexes[corner / 8])
                if (free[j]) body(j);
    };
    auto include = [&](Node i) {
        if (slot[i] >= 0) return;
        slot[i] = 0;
        patch.push_back(i);
    };
    for (Node seed = 0; seed < n; ++seed) {
        if (!free[seed] || taken[seed]) continue;
        patch.clear();
        auto take = [&](Node i) {
            if (taken[i] || static_cast<std::int64_t>(patch.size()) == size) return;
            taken[i] = true;
            include(i);
        };
        take(seed);
        for (std::size_t at = 0; at < patch.size(); ++at) for_each_neighbour(patch[at], take);
        for (std::size_t ring = 0, begin = 0; ring < static_cast<std::size_t>(overlap); ++ring) {
            const std::size_t end = patch.size();
            for (; begin < end; ++begin) for_each_neighbour(Node{patch[begin]}, include);
        }
        std::sort(patch.begin(), patch.end());
        for (std::size_t k = 0; k < patch.size(); ++k) slot[patch[k]] = k;
        for (Node i : patch)
            for (auto corner : mesh.star(i)) {
                const auto h = corner / 8;
                if (used[h] == seed) continue;
                used[h] = seed;
                patch_hexes.push_back(h);
                for (Node j : hexes[h]) slots.push_back(slot[j]);
            }
        for (Node i : patch) slot[i] = -1;
        nodes.insert(nodes.end(), patch.begin(), patch.end());
        node_start.push_back(nodes.size());
        hex_start.push_back(patch_hexes.size());
    }
    return {{std::move(node_start)},
            {std::move(nodes)},
            {std::move(hex_start)},
            {std::move(patch_hexes)},
            {std::move(slots)}};
}

CSR colours(Indices hex_start, Indices patch_hexes, std::int64_t hexes) {
    expect(are_csr(hex_start, patch_hexes.size()),
           "hex_start: its last number is expected to be the length of patch_hexes");
    expect(hexes >= 0, "hexes: the number of hexes is expected");
    auto each_hex = [&](std::int64_t k, const auto &body) {
        for (auto s = hex_start[k]; s < hex_start[k + 1]; ++s) body(patch_hexes[s]);
    };
    auto colour = greedy_colouring(hex_start.size() - 1, hexes, [](std::int64_t) { return true; }, each_hex);
    auto largest = std::max_element(colour.begin(), colour.end());
    return grouped(colour, largest == colour.end() ? 0 : *largest + 1);
}

}  // namespace hexmend
