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

std::tuple<Made<std::int32_t>, Made<std::int32_t>, Made<std::int32_t>, Made<std::int32_t>> split(
    std::int32_t part, Indices row_start, Indices columns) {
    const std::int32_t k = row_start.size() - 1;
    std::vector<std::int32_t> inner_end(k), across_start(k + 1);
    for (std::int32_t i = 0; i < k; ++i) {
        std::int64_t end = (std::int64_t{i} / part + 1) * part;
        auto s = row_start[i + 1];
        while (s > row_start[i] && columns[s - 1] >= end) {
            --s;
            ++across_start[i + 1];
            ++across_start[columns[s] + 1];
        }
        inner_end[i] = s;
    }
    accumulate(across_start);
    std::vector<std::int32_t> place(across_start.begin(), across_start.end() - 1);
    std::vector<std::int32_t> across_block(across_start[k]), across_slot(across_start[k]);
    auto add = [&](std::int32_t i, std::int32_t block, std::int32_t other) {
        across_block[place[i]] = block, across_slot[place[i]] = other;
        ++place[i];
    };
    for (std::int32_t i = 0; i < k; ++i)
        for (auto s = inner_end[i]; s < row_start[i + 1]; ++s) {
            add(i, s, columns[s]);
            add(columns[s], s, i);
        }
    return {{std::move(inner_end)}, {std::move(across_start)}, {std::move(across_block)}, {std::move(across_slot)}};
}

}  // namespace hexmend
