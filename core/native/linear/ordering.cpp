#include "linear/sparsity.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace hexmend {
namespace {

// The graph of the free nodes, joined by edges of hexes.
class Graph {
  public:
    Graph(Indices start, Indices items, std::span<const bool> free)
        : start_(start), items_(items), free_(free), degree_(free.size()) {
        for (Node i = 0; i < nodes(); ++i)
            for (auto s = start[i]; s < start[i + 1]; ++s) degree_[i] += free[items[s]];
    }

    Node nodes() const { return static_cast<Node>(free_.size()); }
    bool has(Node i) const { return free_[i]; }

    int degree(Node i) const { return degree_[i]; }

    // Append the nodes that are not `seen`, breadth first from the last node of `order`, neighbours of lower degree
    // first. Returns the start of the last level.
    std::size_t walk(std::vector<Node> &order, std::vector<bool> &seen) const {
        std::vector<std::pair<int, Node>> next;
        std::size_t at = order.size() - 1, level = at;
        seen[order[at]] = true;
        for (std::size_t end = order.size(); at < order.size(); end = order.size()) {
            level = at;
            for (; at < end; ++at) {
                next.clear();
                for (auto s = start_[order[at]]; s < start_[order[at] + 1]; ++s) {
                    Node j = items_[s];
                    if (!free_[j] || seen[j]) continue;
                    seen[j] = true;
                    next.emplace_back(degree(j), j);
                }
                std::sort(next.begin(), next.end());
                for (auto [degree, j] : next) order.push_back(j);
            }
        }
        return level;
    }

  private:
    Indices start_, items_;
    std::span<const bool> free_;
    std::vector<int> degree_;
};

// Cuthill and McKee 1969: breadth first from a peripheral node. Coordinates play no part, so that rotating a mesh does
// not change how it is smoothed.
std::vector<Node> cuthill_mckee(const Graph &graph) {
    std::vector<Node> order, trial;
    std::vector<bool> seen(graph.nodes()), tried(graph.nodes());
    for (Node i = 0; i < graph.nodes(); ++i) {
        if (!graph.has(i) || seen[i]) continue;
        trial.assign(1, i);
        auto last = graph.walk(trial, tried);
        // A node of the last level is peripheral.
        Node rim = *std::min_element(trial.begin() + last, trial.end(), [&](Node a, Node b) {
            return std::pair(graph.degree(a), a) < std::pair(graph.degree(b), b);
        });
        order.push_back(rim);
        graph.walk(order, seen);
    }
    return order;
}

// Range of some numbers.
struct Range {
    int least = std::numeric_limits<int>::max(), greatest = -1;

    void take(int number) { least = std::min(least, number), greatest = std::max(greatest, number); }
    bool none() const { return greatest < 0; }
    bool one() const { return least == greatest; }
};

// The part (from 0) or separator (from `parts`) of each node, -1 if it is fixed; empty if a part would be too thin.
std::vector<int> partition_slots(const std::vector<Node> &order, Hexes hexes, std::size_t nodes, int parts) {
    std::vector<int> part(nodes, -1);
    for (std::size_t k = 0; k < order.size(); ++k) part[order[k]] = static_cast<int>(k * parts / order.size());
    std::vector<int> range = part;
    for (const Hex &hex : hexes) {
        Range met;
        for (Node i : hex)
            if (part[i] >= 0) met.take(part[i]);
        if (met.none() || met.one()) continue;
        for (Node i : hex)
            if (part[i] == met.greatest) range[i] = parts + met.greatest - 1;
    }
    // A hex may have nodes of one part and one adjacent separator only.
    for (const Hex &hex : hexes) {
        Range part_met, separator_met;
        for (Node i : hex)
            if (range[i] >= 0) (range[i] < parts ? part_met : separator_met).take(range[i]);
        int side = separator_met.greatest - parts - part_met.greatest;
        bool valid = (part_met.none() || part_met.one()) && (separator_met.none() || separator_met.one()) &&
                     (part_met.none() || separator_met.none() || side == 0 || side == -1);
        if (!valid) return {};
    }
    return range;
}

}  // namespace

CSR slots(Hexes hexes, Indices ring_start, Indices ring, std::span<const bool> free, int parts) {
    expect_rings(free.size(), ring_start, ring);
    auto order = cuthill_mckee({ring_start, ring, free});
    std::vector<int> range;
    parts = std::max(parts, 1);
    while (parts > 1 && (range = partition_slots(order, hexes, free.size(), parts)).empty()) --parts;
    std::vector<std::int32_t> bounds(2 * parts);
    if (parts == 1) {
        bounds[1] = static_cast<std::int32_t>(order.size());
    } else {
        std::stable_sort(order.begin(), order.end(), [&](Node a, Node b) { return range[a] < range[b]; });
        for (Node i : order) ++bounds[range[i] + 1];
        std::partial_sum(bounds.begin(), bounds.end(), bounds.begin());
    }
    return {{std::move(order)}, {std::move(bounds)}};
}

}  // namespace hexmend
