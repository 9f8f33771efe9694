#include "view/corner_values.hpp"

#include <algorithm>

namespace hexmend {

void largest(Hexes hexes, Numbers of_nodes, std::span<double> of_hexes) {
    for (std::size_t h = 0; h < hexes.size(); ++h) {
        double most = of_nodes[hexes[h][0]];
        for (Node node : hexes[h]) most = std::max(most, of_nodes[node]);
        of_hexes[h] = most;
    }
}

void mean(Hexes hexes, Numbers of_nodes, std::span<double> of_hexes) {
    for (std::size_t h = 0; h < hexes.size(); ++h) {
        double sum = 0;
        for (Node node : hexes[h]) sum += of_nodes[node];
        of_hexes[h] = sum / 8;
    }
}

}  // namespace hexmend
