// Blocks above the diagonal while hexes are added to them.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "linear/packed_block.hpp"
#include "mesh/array_views.hpp"

namespace hexmend {

// All blocks of a matrix, which hexes are added to where they are.
template <class Real> struct WholeBlocks {
    std::span<std::array<Real, 9>> all;

    std::array<Real, 9> &operator[](std::int32_t s) { return all[s]; }
    void prefetch(std::int32_t s) { __builtin_prefetch(&all[s], 1), __builtin_prefetch(&all[s][8], 1); }
    void open_rows(std::int32_t, std::int32_t) {}
    void close() {}
};

// Blocks of the rows `low` to `high` - 1, which are packed once all hexes at their rows are added. Hexes come in the
// order of their lowest slots: the rows before that of the next hex are complete. A ring holds the others; rows from
// `first_separator` on, which hexes of all parts meet, are held until the end.
class OpenBlocks {
  public:
    // The diagonal gets what belongs to fixed nodes alone: `complete_diagonal` adds the rest.
    static constexpr bool diagonal_from_fixed_nodes = true;

    OpenBlocks(Indices row_start, std::int32_t low, std::int32_t high, std::int32_t first_separator,
               std::span<PackedBlock> packed)
        : row_start_(row_start),
          packed_(packed),
          end_row_(std::clamp(first_separator, low, high)),
          closed_row_(low),
          closed_(row_start[low]),
          ring_end_(row_start[end_row_]),
          end_(row_start[high]),
          ring_(1),
          separators_(end_ - ring_end_) {}

    // Block s of one of the rows.
    std::array<float, 9> &operator[](std::int32_t s) { return *at(s); }
    void prefetch(std::int32_t s) {
        if (s >= closed_ && s < end_) __builtin_prefetch(at(s), 1), __builtin_prefetch(at(s)->data() + 8, 1);
    }

    // Pack the rows before the lowest slot of the hexes that follow, and make room for rows to their highest one.
    void open_rows(std::int32_t lowest, std::int32_t highest) {
        close_to(std::min(lowest, end_row_));
        if (highest >= closed_row_) reserve(row_start_[std::min(highest + 1, end_row_)] - closed_);
    }

    void close() {
        close_to(end_row_);
        for (auto s = ring_end_; s < end_; ++s) packed_[s] = packed(separators_[s - ring_end_]);
    }

  private:
    Indices row_start_;
    std::span<PackedBlock> packed_;
    std::int32_t end_row_, closed_row_, closed_, ring_end_, end_;
    std::int32_t mask_ = 0;  // block s is in place s & mask_ of the ring
    std::vector<std::array<float, 9>> ring_, separators_;

    std::array<float, 9> *at(std::int32_t s) {
        if (s >= ring_end_) return separators_.data() + (s - ring_end_);
        return ring_.data() + (s & mask_);
    }

    void close_to(std::int32_t row) {
        if (row <= closed_row_) return;
        reserve(row_start_[row] - closed_);  // of rows that no hex has opened
        for (const auto end = row_start_[row]; closed_ < end; ++closed_)
            packed_[closed_] = packed(std::exchange(ring_[closed_ & mask_], {}));
        closed_row_ = row;
    }

    void reserve(std::int64_t open) {
        const auto size = static_cast<std::int64_t>(ring_.size());
        if (open <= size) return;
        std::vector<std::array<float, 9>> wider(std::bit_ceil(static_cast<std::size_t>(open)));
        const auto mask = static_cast<std::int32_t>(wider.size() - 1);
        for (std::int64_t s = closed_; s < std::min(closed_ + size, std::int64_t{ring_end_}); ++s)
            wider[s & mask] = ring_[s & mask_];
        ring_ = std::move(wider), mask_ = mask;
    }
};

}  // namespace hexmend
