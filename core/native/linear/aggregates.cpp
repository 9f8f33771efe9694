#include "linear/aggregates.hpp"

#include <limits>

#include "mesh/csr.hpp"

namespace hexmend {
namespace {

// The aggregate of each slot.
std::vector<std::int32_t> aggregates(Indices slot_of_node, Indices nodes, Indices ring_start, Indices ring,
                                     int distance) {
    const auto count = static_cast<std::int32_t>(nodes.size());
    std::vector<std::int32_t> nearest(count), level(count, std::numeric_limits<std::int32_t>::max()), queue;
    std::int32_t centres = 0;
    for (std::int32_t centre = 0; centre < count; ++centre) {
        if (level[centre] <= distance) continue;
        queue.assign(1, centre);
        level[centre] = 0, nearest[centre] = centres;
        for (std::size_t at = 0; at < queue.size(); ++at) {  // breadth first, where no earlier centre is as near
            auto i = queue[at];
            if (level[i] == distance) break;
            for (auto s = ring_start[nodes[i]]; s < ring_start[nodes[i] + 1]; ++s) {
                auto j = slot_of_node[ring[s]];
                if (j < 0 || level[j] <= level[i] + 1) continue;
                level[j] = level[i] + 1, nearest[j] = centres;
                queue.push_back(j);
            }
        }
        ++centres;
    }
    return nearest;
}

}  // namespace

std::tuple<IntArray, IntArray, IntArray> coarse_pattern(Hexes slots, Indices slot_of_node, Indices nodes,
                                                        Indices ring_start, Indices ring, Indices start,
                                                        Indices corners, int distance) {
    expect_corners(slots.size(), start, corners);
    expect_rings(slot_of_node.size(), ring_start, ring);
    expect(start.size() == ring_start.size(), "start: one more than the nodes is expected");
    auto aggregate = aggregates(slot_of_node, nodes, ring_start, ring, distance);
    const auto width = std::max(8 * widest(start), 1);
    CSRBuilder<std::int32_t> rows(nodes.size(), width, MOST_ITEMS, [&](std::int64_t i, std::int32_t *items) {
        int size = 0;
        for (auto s = start[nodes[i]]; s < start[nodes[i] + 1]; ++s)
            for (auto j : slots[corners[s] / 8])
                if (j >= 0) placed(items, size, aggregate[j]);
        return size;
    });
    auto [row_start, columns] = arrays(std::move(rows));
    return {{std::move(aggregate)}, std::move(row_start), std::move(columns)};
}

}  // namespace hexmend
