#include "linear/sparsity.hpp"

#include <algorithm>

#include "mesh/csr.hpp"

namespace hexmend {
namespace {

// The corner at the other end of the diagonal of the hex.
constexpr auto OPPOSITE = [] {
    std::array<int, 8> other{};
    for (auto [a, b] : DIAGONALS) other[a] = b, other[b] = a;
    return other;
}();

}  // namespace

CSR pattern(Hexes slots, Indices nodes, Indices start, Indices corners, bool opposite, std::int64_t max_items) {
    expect_corners(slots.size(), start, corners);
    const auto width = std::max(8 * widest(start), 1);
    return arrays(CSRBuilder<std::int32_t>(nodes.size(), width, max_items, [&](std::int64_t i, std::int32_t *row) {
        auto *end = row;
        for (auto s = start[nodes[i]]; s < start[nodes[i] + 1]; ++s) {
            const int other = opposite ? -1 : OPPOSITE[corners[s] % 8];
            const Hex &hex = slots[corners[s] / 8];
            for (int c = 0; c < 8; ++c)
                if (c != other && hex[c] > i) *end++ = hex[c];
        }
        std::sort(row, end);
        return static_cast<int>(std::unique(row, end) - row);
    }));
}

}  // namespace hexmend
