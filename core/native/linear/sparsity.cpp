#include "linear/sparsity.hpp"

#include <algorithm>

#include "mesh/csr.hpp"

namespace hexmend {
namespace {

// Chunks of slots that are processed in parallel; each needs a number for every slot.
constexpr std::int64_t PIECES = 16;

// The corner at the other end of the diagonal of the hex.
constexpr auto OPPOSITE = [] {
    std::array<int, 8> other{};
    for (auto [a, b] : DIAGONALS) other[a] = b, other[b] = a;
    return other;
}();

}  // namespace

CSR pattern(Hexes slots, Indices nodes, Indices start, Indices corners, bool opposite, std::int64_t max_items) {
    expect_corners(slots.size(), start, corners);
    std::int64_t count = nodes.size(), size = std::max<std::int64_t>((count + PIECES - 1) / PIECES, 1);
    std::vector<std::int32_t> row_start(count + 1), found[PIECES];
    parallel_chunks(count, size, [&](std::int64_t begin, std::int64_t end) {
        auto &columns = found[begin / size];
        std::vector<std::int32_t> met_by(count, -1);
        for (auto i = static_cast<std::int32_t>(begin); i < end; ++i) {
            auto first = columns.size();
            for (auto s = start[nodes[i]]; s < start[nodes[i] + 1]; ++s) {
                const int other = opposite ? -1 : OPPOSITE[corners[s] % 8];
                const Hex &hex = slots[corners[s] / 8];
                for (int c = 0; c < 8; ++c) {
                    auto j = hex[c];
                    if (c == other || j <= i || met_by[j] == i) continue;
                    met_by[j] = i;
                    columns.push_back(j);
                }
            }
            std::sort(columns.begin() + first, columns.end());
            row_start[i + 1] = static_cast<std::int32_t>(columns.size() - first);
        }
    });
    accumulate(row_start, max_items);

    std::vector<std::int32_t> columns(row_start[count]);
    parallel_chunks(count, size, [&](std::int64_t begin, std::int64_t) {
        auto &own = found[begin / size];
        std::copy(own.begin(), own.end(), columns.begin() + row_start[begin]);
        own = {};
    });
    return {{std::move(row_start)}, {std::move(columns)}};
}

}  // namespace hexmend
