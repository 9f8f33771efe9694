#include "mesh/sheets.hpp"

#include <algorithm>

namespace hexmend {
namespace {

void check(EdgeGroups groups, std::size_t values) {
    auto fits = [&](std::int32_t edge) { return edge >= 0 && std::size_t(edge) < values; };
    bool all = std::ranges::all_of(groups, [&](const auto &group) { return std::ranges::all_of(group, fits); });
    expect(values > 0 && all, "groups must hold numbers of edges, or the number of edges for none");
}

}  // namespace

void average_along_sheets(EdgeGroups groups, Numbers values, std::span<double> average, std::span<std::int32_t> count) {
    check(groups, values.size());
    expect(average.size() == values.size() && count.size() == values.size(), "average and count must be as values");
    const auto none = std::int32_t(values.size() - 1);
    std::ranges::fill(average, 0.0);
    std::ranges::fill(count, 0);
    for (const auto &group : groups) {
        double sum = 0;
        int size = 0;
        for (auto edge : group)
            if (edge != none) sum += values[edge], ++size;
        if (!size) continue;
        for (auto edge : group) average[edge] += sum / size, ++count[edge];
    }
    for (std::size_t i = 0; i < average.size(); ++i) average[i] /= std::max(count[i], 1);
    average[none] = 0, count[none] = 0;
}

}  // namespace hexmend
