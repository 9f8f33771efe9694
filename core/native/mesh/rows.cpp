#include "mesh/rows.hpp"

#include "simd/threads.hpp"

namespace hexmend {

template <std::size_t width>
void any_marked(std::span<const bool> marks, std::span<const std::array<std::int32_t, width>> rows,
                std::span<bool> found) {
    constexpr std::int64_t ROWS_PER_CHUNK = 8192;
    expect(found.size() == rows.size(), "found: one for each of rows is expected");
    const auto *mark = reinterpret_cast<const std::uint8_t *>(marks.data());
    parallel_for(rows.size(), ROWS_PER_CHUNK, [&](std::int64_t i) {
        std::uint8_t any = 0;  // without branches, which could not be predicted
        for (std::int32_t number : rows[i]) any |= mark[number];
        found[i] = any != 0;
    });
}

template void any_marked<4>(std::span<const bool>, std::span<const std::array<std::int32_t, 4>>, std::span<bool>);
template void any_marked<8>(std::span<const bool>, std::span<const std::array<std::int32_t, 8>>, std::span<bool>);

void put_rows(Points values, Indices numbers, std::span<Point> points) {
    expect(values.size() == numbers.size(), "values: a row for each of numbers is expected");
    for (std::size_t k = 0; k < numbers.size(); ++k) points[numbers[k]] = values[k];
}

void scale_rows(Points factors, Indices numbers, std::span<Point> vectors) {
    expect(factors.size() == numbers.size(), "factors: a row for each of numbers is expected");
    for (std::size_t k = 0; k < numbers.size(); ++k)
        for (int i = 0; i < 3; ++i) vectors[numbers[k]][i] *= factors[k][i];
}

}  // namespace hexmend
