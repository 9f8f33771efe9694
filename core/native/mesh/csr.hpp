// Compressed sparse rows: row i is items[start[i]] to items[start[i + 1] - 1].
#pragma once

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "mesh/array_views.hpp"
#include "simd/threads.hpp"

namespace hexmend {

// Rows that one thread takes at a time.
constexpr std::int64_t ROWS_PER_CHUNK = 1024;

// Insert an item into a row that ascends by key, unless the row has an item of that key; returns its position.
template <class Item, class Key> inline Item *placed(Item *begin, int &size, const Item &item, const Key &key) {
    int j = size;
    while (j > 0 && key(begin[j - 1]) > key(item)) --j;
    if (j > 0 && key(begin[j - 1]) == key(item)) return begin + j - 1;
    for (int t = size++; t > j; --t) begin[t] = begin[t - 1];  // few: calling memmove costs more
    begin[j] = item;
    return begin + j;
}

inline int *placed(int *begin, int &size, int item) {
    return placed(begin, size, item, [](int i) { return i; });
}

// The length of the longest row.
inline int widest(Indices start) {
    int most = 0;
    for (std::size_t i = 1; i < start.size(); ++i) most = std::max(most, start[i] - start[i - 1]);
    return most;
}

// The largest number of items: row ends are 32-bit numbers.
constexpr std::int64_t MOST_ITEMS = std::numeric_limits<std::int32_t>::max();

// Replace row lengths start[i] by row ends. Throws std::overflow_error if there are more than `max_items` items.
inline void accumulate(std::span<std::int32_t> start, std::int64_t max_items = MOST_ITEMS) {
    std::int64_t total = 0;
    for (auto count : start) total += count;
    if (total > max_items)
        throw std::overflow_error("there are " + std::to_string(total) + " items: expected " +
                                  std::to_string(max_items) + " at most");
    for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
}

// Rows of the numbers 0 to items - 1, ascending: number k is in row row_of(k), in none where that is negative.
template <class RowOf>
std::pair<std::vector<std::int32_t>, std::vector<std::int32_t>> group_by(std::int64_t rows, std::int64_t items,
                                                                         const RowOf &row_of) {
    std::vector<std::int32_t> start(rows + 1);
    for (std::int64_t k = 0; k < items; ++k)
        if (auto row = row_of(k); row >= 0) ++start[row];
    accumulate(start);
    std::vector<std::int32_t> numbers(start[rows]);
    // From the last to the first, so that each row's end is counted down to its start.
    for (std::int64_t k = items - 1; k >= 0; --k)
        if (auto row = row_of(k); row >= 0) numbers[--start[row]] = static_cast<std::int32_t>(k);
    return {std::move(start), std::move(numbers)};
}

// Builds rows of unknown length: chunks of rows in parallel, then all of them one after another.
template <class Item> class CSRBuilder {
  public:
    // row(i, items) writes the items of row i, at most `width`, and returns their number; all `count` rows together may
    // have `max_items` items.
    template <class Row> CSRBuilder(std::int64_t count, std::int64_t width, std::int64_t max_items, const Row &row) {
        start_.resize(count + 1);
        chunks_.resize((count + ROWS_PER_CHUNK - 1) / ROWS_PER_CHUNK);
        parallel_chunks(count, ROWS_PER_CHUNK, [&](std::int64_t begin, std::int64_t end) {
            std::vector<Item> items(width), &chunk = chunks_[begin / ROWS_PER_CHUNK];
            for (std::int64_t i = begin; i < end; ++i) {
                int size = start_[i + 1] = row(i, items.data());
                chunk.insert(chunk.end(), items.data(), items.data() + size);
            }
        });
        accumulate(start_, max_items);
    }

    std::int64_t size() const { return start_.back(); }

    // Call body(i, k, item) for each item of each row i, in any order; k is its position among all items.
    template <class Body> void each(const Body &body) const {
        parallel_chunks(start_.size() - 1, ROWS_PER_CHUNK, [&](std::int64_t begin, std::int64_t end) {
            const Item *item = chunks_[begin / ROWS_PER_CHUNK].data();
            for (std::int64_t i = begin; i < end; ++i)
                for (std::int64_t k = start_[i]; k < start_[i + 1]; ++k) body(i, k, *item++);
        });
    }

    std::vector<std::int32_t> &&start() && { return std::move(start_); }

  private:
    std::vector<std::int32_t> start_;
    std::vector<std::vector<Item>> chunks_;
};

// Rows of `count` + 1 starts and their items, as arrays.
inline CSR arrays(CSRBuilder<std::int32_t> &&rows) {
    std::vector<std::int32_t> items(rows.size());
    rows.each([&](std::int64_t, std::int64_t k, std::int32_t item) { items[k] = item; });
    return {{std::move(rows).start()}, {std::move(items)}};
}

}  // namespace hexmend
