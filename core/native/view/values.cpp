#include <algorithm>

#include "view/view.hpp"

namespace hexmend {

void largest(Hexes hexes, Numbers of_nodes, std::span<double> of_hexes) {
    expect(of_hexes.size() == hexes.size(), "of_hexes: one for each of hexes is expected");
    for (std::size_t h = 0; h < hexes.size(); ++h) {
        double most = of_nodes[hexes[h][0]];
        for (Node node : hexes[h]) most = std::max(most, of_nodes[node]);
        of_hexes[h] = most;
    }
}

void mean(Hexes hexes, Numbers of_nodes, std::span<double> of_hexes) {
    expect(of_hexes.size() == hexes.size(), "of_hexes: one for each of hexes is expected");
    for (std::size_t h = 0; h < hexes.size(); ++h) {
        double sum = 0;
        for (Node node : hexes[h]) sum += of_nodes[node];
        of_hexes[h] = sum / 8;
    }
}

void count(Numbers values, std::span<const bool> inverted, double low, double scale, bool open_low, bool open_high,
           std::span<std::int64_t> counts) {
    expect(inverted.size() == values.size(), "inverted: one for each of values is expected");
    expect(counts.size() >= 4, "counts: one bin at least is expected, and three more");
    std::size_t bins = counts.size() - 3, above = bins, below = bins + 1, none = bins + 2;
    std::size_t first = open_low ? below : 0, last = open_high ? above : bins - 1;
    std::fill(counts.begin(), counts.end(), 0);
    for (std::size_t i = 0; i < values.size(); ++i) {
        double place = (values[i] - low) * scale;
        if (inverted[i] || std::isnan(place)) ++counts[none];
        else if (place < 0) ++counts[first];
        else if (place >= static_cast<double>(bins)) ++counts[last];
        else ++counts[static_cast<std::size_t>(place)];
    }
}

}  // namespace hexmend
