#include "boundary/surface_points.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <memory>
#include <new>
#include <numeric>

#include "mesh/incidence.hpp"

namespace hexmend {
namespace {

// Slots of the hash table for each point, at least.
constexpr std::size_t SLOTS_PER_POINT = 2;

std::uint64_t hash(const Point &x) {
    std::uint64_t h = 0;
    for (double coordinate : x) {
        h ^= std::bit_cast<std::uint64_t>(coordinate + 0.0);  // of 0 and -0
        h *= 0x9E3779B97F4A7C15u;
        h ^= h >> 29;
    }
    return h;
}

// Zeros in pages that take memory once they are written.
struct Free {
    void operator()(void *p) const { std::free(p); }
};
std::unique_ptr<std::int32_t[], Free> zeros(std::size_t count) {
    auto *p = static_cast<std::int32_t *>(std::calloc(std::max<std::size_t>(count, 1), sizeof(std::int32_t)));
    if (!p) throw std::bad_alloc();
    return std::unique_ptr<std::int32_t[], Free>(p);
}

}  // namespace

IntArray numbers_of_different_points(Points points) {
    const std::size_t slots = std::bit_ceil(SLOTS_PER_POINT * points.size() + 1);
    auto table = zeros(slots);  // one more than the number of a different point, 0 for none
    std::vector<std::int32_t> numbers(points.size()), first;
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::size_t slot = hash(points[i]) & (slots - 1);
        while (table[slot] && points[first[table[slot] - 1]] != points[i]) slot = (slot + 1) & (slots - 1);
        if (!table[slot]) {
            first.push_back(static_cast<std::int32_t>(i));
            table[slot] = static_cast<std::int32_t>(first.size());
        }
        numbers[i] = table[slot] - 1;
    }
    return {std::move(numbers)};
}

IntArray count_fans(Indices faces, int width, Indices sides, Indices first, std::int64_t nodes) {
    std::vector<std::int32_t> parent(faces.size()), count(nodes);  // corners of faces that are of one fan are joined
    std::iota(parent.begin(), parent.end(), 0);
    auto join_corners = [&](std::int32_t one, std::int32_t other) { join(parent, std::array{one, other}, 2); };
    auto next = [&](std::int32_t corner) { return corner % width + 1 < width ? corner + 1 : corner + 1 - width; };
    for (std::size_t e = 0; e + 1 < first.size(); ++e) {
        for (std::int32_t k = first[e] + 1; k < first[e + 1]; ++k) {
            const std::int32_t one = sides[k - 1], other = sides[k];
            const bool opposed = faces[one] != faces[other];
            join_corners(one, opposed ? next(other) : other);
            join_corners(next(one), opposed ? other : next(other));
        }
    }
    // Successive corners of a face that are one node are of one fan.
    for (std::int32_t corner = 0; corner < static_cast<std::int32_t>(faces.size()); ++corner)
        if (faces[corner] == faces[next(corner)]) join_corners(corner, next(corner));
    for (std::size_t corner = 0; corner < faces.size(); ++corner)
        count[faces[corner]] += parent[corner] == static_cast<std::int32_t>(corner);
    return {std::move(count)};
}

OwnedArray<bool> extremes_in_cells(Indices cell, Numbers values, std::int64_t cells) {
    expect(cell.size() == values.size(), "values: one for each of the cells of points is expected");
    for (std::int32_t c : cell) expect(c >= 0 && c < cells, "cell: a number is out of range");
    auto least = zeros(cells), most = zeros(cells);  // one more than the number of the point, 0 for none
    for (std::size_t i = 0; i < cell.size(); ++i) {
        std::int32_t &low = least[cell[i]], &high = most[cell[i]];
        if (!low || values[i] < values[low - 1]) low = static_cast<std::int32_t>(i + 1);
        if (!high || values[i] >= values[high - 1]) high = static_cast<std::int32_t>(i + 1);
    }
    OwnedArray<bool> found{std::vector<std::uint8_t>(cell.size())};
    for (std::int32_t c : cell) found.values[least[c] - 1] = found.values[most[c] - 1] = true;
    return found;
}

}  // namespace hexmend
