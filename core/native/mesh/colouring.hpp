// Greedy colouring of things that occupy hexes: two that share a hex never have the same colour.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace hexmend {

// Colour of each of `count` items, the lowest that none of its hexes has yet, in the order of their numbers; -1 where
// uses(i) is false. each_hex(i, body) calls body(h) for the hexes of item i, numbers below `hexes`.
template <class Uses, class EachHex>
std::vector<std::int32_t> greedy_colouring(std::int64_t count, std::int64_t hexes, const Uses &uses,
                                           const EachHex &each_hex) {
    std::vector<std::int32_t> colour(count, -1);
    std::vector<std::uint64_t> taken;  // of each hex, the colours of its items: 64 of them at a time
    bool more = true;
    for (int first = 0; more; first += 64) {
        more = false;
        taken.assign(hexes, 0);
        for (std::int64_t i = 0; i < count; ++i) {
            if (!uses(i) || colour[i] >= 0) continue;
            std::uint64_t seen = 0;
            each_hex(i, [&](std::int32_t h) { seen |= taken[h]; });
            int k = std::countr_one(seen);
            if (k == 64) {  // its colour is above those of this round, whatever later items take
                more = true;
                continue;
            }
            colour[i] = first + k;
            each_hex(i, [&](std::int32_t h) { taken[h] |= std::uint64_t{1} << k; });
        }
    }
    return colour;
}

}  // namespace hexmend
