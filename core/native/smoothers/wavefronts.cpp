#include "smoothers/wavefronts.hpp"

#include <algorithm>

#include "mesh/csr.hpp"

namespace hexmend {

IntArray levels(Indices ring_start, Indices ring, std::span<const bool> from) {
    expect_rings(from.size(), ring_start, ring);
    return {breadth_first_levels(
        from.size(), [&](std::int64_t i) { return from[i]; },
        [&](std::int32_t i, const auto &body) {
            for (auto s = ring_start[i]; s < ring_start[i + 1]; ++s) body(ring[s]);
        })};
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
