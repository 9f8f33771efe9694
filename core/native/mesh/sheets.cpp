#include "mesh/sheets.hpp"

#include <algorithm>

namespace hexmend {
namespace {

void check(EdgeGroups groups, std::size_t values) {
    auto fits = [&](std::int32_t edge) { return edge >= 0 && std::size_t(edge) < values; };
    bool all = std::ranges::all_of(groups, [&](const auto &group) { return std::ranges::all_of(group, fits); });
    expect(values > 0 && all, "groups must hold numbers of edges, or the number of edges for none");
}

// Groups of each edge, ascending, as compressed rows.
struct GroupsOfEdges {
    std::vector<std::int32_t> start, items;

    GroupsOfEdges(EdgeGroups groups, std::size_t edges) : start(edges + 2), items(4 * groups.size()) {
        for (const auto &group : groups)
            for (auto edge : group) ++start[edge + 2];
        for (std::size_t i = 2; i < start.size(); ++i) start[i] += start[i - 1];
        for (std::size_t g = 0; g < groups.size(); ++g)
            for (auto edge : groups[g]) items[start[edge + 1]++] = std::int32_t(g);
    }

    std::span<const std::int32_t> operator[](std::int32_t edge) const {
        return {items.data() + start[edge], items.data() + start[edge + 1]};
    }
};

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

void fill_along_sheets(EdgeGroups groups, std::span<double> values, std::span<bool> known) {
    check(groups, values.size());
    expect(known.size() == values.size(), "known must be as values");
    const auto none = std::int32_t(values.size() - 1);
    auto has = [&](const auto &group, bool which) {
        return std::ranges::any_of(group, [&](auto edge) { return edge != none && known[edge] == which; });
    };
    GroupsOfEdges around(groups, values.size());
    std::vector<double> total(values.size());
    std::vector<std::int32_t> count(values.size()), front, reached;
    std::vector<std::uint8_t> listed(groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g)
        if (has(groups[g], true) && has(groups[g], false)) front.push_back(std::int32_t(g));
    while (!front.empty()) {
        reached.clear();
        for (auto g : front) {
            double sum = 0;
            int size = 0;
            for (auto edge : groups[g])
                if (edge != none && known[edge]) sum += values[edge], ++size;
            for (auto edge : groups[g]) {
                if (edge == none || known[edge]) continue;
                total[edge] += sum / size;
                if (!count[edge]++) reached.push_back(edge);
            }
        }
        for (auto edge : reached) values[edge] = total[edge] / count[edge], known[edge] = true;
        front.clear();  // a group has but one front: all its edges are known after it
        for (auto edge : reached)
            for (auto g : around[edge])
                if (!listed[g] && has(groups[g], false)) listed[g] = 1, front.push_back(g);
        std::ranges::sort(front);
    }
}

}  // namespace hexmend
