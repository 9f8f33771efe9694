#include "linear/sparsity.hpp"

#include <algorithm>

#include "mesh/csr.hpp"

namespace hexmend {
namespace {

// Chunks of slots that are processed in parallel; each needs a number for every slot.
constexpr std::int64_t PIECES = 16;

}  // namespace

std::tuple<IntArray, IntArray, OwnedArray<PairBlock, PAIRS>> pattern(Hexes slots, Indices nodes, Indices start,
                                                                     Indices corners, std::int64_t max_items) {
    std::int64_t count = nodes.size(), size = std::max<std::int64_t>((count + PIECES - 1) / PIECES, 1);
    std::vector<std::int32_t> row_start(count + 1), found[PIECES];
    parallel_chunks(count, size, [&](std::int64_t begin, std::int64_t end) {
        auto &columns = found[begin / size];
        std::vector<std::int32_t> met_by(count, -1);
        for (auto i = static_cast<std::int32_t>(begin); i < end; ++i) {
            auto first = columns.size();
            for (auto s = start[nodes[i]]; s < start[nodes[i] + 1]; ++s)
                for (auto j : slots[corners[s] / 8])
                    if (j > i && met_by[j] != i) {
                        met_by[j] = i;
                        columns.push_back(j);
                    }
            std::sort(columns.begin() + first, columns.end());
            row_start[i + 1] = static_cast<std::int32_t>(columns.size() - first);
        }
    });
    accumulate(row_start, max_items);

    for (std::int64_t i = 0; i < count; ++i)
        if (row_start[i + 1] - row_start[i] >= NO_BLOCK)
            throw std::overflow_error("a node shares hexes with too many nodes: fewer than 65,535 are expected");
    std::vector<std::int32_t> columns(row_start[count]);
    std::vector<PairBlock> target(slots.size() * PAIRS, NO_BLOCK);
    parallel_chunks(count, size, [&](std::int64_t begin, std::int64_t end) {
        std::copy(found[begin / size].begin(), found[begin / size].end(), columns.begin() + row_start[begin]);
        std::vector<std::int32_t> block(count);
        for (auto i = static_cast<std::int32_t>(begin); i < end; ++i) {
            for (auto s = row_start[i]; s < row_start[i + 1]; ++s) block[columns[s]] = s;
            for (auto s = start[nodes[i]]; s < start[nodes[i] + 1]; ++s) {
                int h = corners[s] / 8, a = corners[s] % 8;
                for (int b = 0; b < 8; ++b) {
                    auto j = slots[h][b];
                    if (j <= i) continue;
                    target[PAIRS * std::int64_t{h} + pair_of(std::min(a, b), std::max(a, b))] =
                        static_cast<PairBlock>(block[j] - row_start[i]);
                }
            }
        }
    });
    return {{std::move(row_start)}, {std::move(columns)}, {std::move(target)}};
}

}  // namespace hexmend
