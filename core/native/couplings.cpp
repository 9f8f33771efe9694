#include "couplings.hpp"

#include "compressed.hpp"

namespace hexmend {

std::pair<Made<std::int32_t>, Made<std::int32_t>> rows(Hexes slots, Indices nodes, Indices start, Indices corners) {
    return arrays(CompressedRows<std::int32_t>(nodes.size(), 7 * widest(start) + 1, [&](std::int64_t i, int *row) {
        int size = 0;
        for (auto s = start[nodes[i]]; s < start[nodes[i] + 1]; ++s)
            for (auto j : slots[corners[s] / 8])
                if (j > i) placed(row, size, j);
        return size;
    }));
}

void targets(Hexes slots, Indices row_start, Indices columns, std::span<std::array<std::int32_t, PAIRS>> target) {
    parallel_chunks(slots.size(), ROWS, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t h = begin; h < end; ++h) {
            int pair = 0;
            for (int a = 0; a < 8; ++a)
                for (int b = a + 1; b < 8; ++b, ++pair) {
                    auto [low, high] = std::minmax(slots[h][a], slots[h][b]);
                    auto &to = target[h][pair];
                    if (low < 0) to = -1;
                    else if (low == high) to = -2 - low;
                    else {
                        to = row_start[low];
                        while (columns[to] != high) ++to;
                    }
                }
        }
    });
}

}  // namespace hexmend
