#include "smoothers/wavefronts.hpp"

#include <algorithm>

#include "mesh/csr.hpp"

namespace hexmend {

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
    expect_corners(corners.size() / 8, start, corners);
    std::vector<std::int32_t> next(corners.size() / 8);  // of each hex: one more than the group of its latest node
    std::vector<std::int32_t> group(sequence.size()), group_start(1);
    for (std::size_t k = 0; k < sequence.size(); ++k) {
        const Node i = sequence[k];
        for (auto s = start[i]; s < start[i + 1]; ++s) group[k] = std::max(group[k], next[corners[s] / 8]);
        for (auto s = start[i]; s < start[i + 1]; ++s) next[corners[s] / 8] = group[k] + 1;
        if (static_cast<std::size_t>(group[k]) + 2 > group_start.size()) group_start.push_back(0);
        ++group_start[group[k] + 1];
    }
    accumulate(group_start);
    std::vector<std::int32_t> nodes(sequence.size()), end(group_start);
    for (std::size_t k = 0; k < sequence.size(); ++k) nodes[end[group[k]]++] = sequence[k];
    return {{std::move(group_start)}, {std::move(nodes)}};
}

}  // namespace hexmend
