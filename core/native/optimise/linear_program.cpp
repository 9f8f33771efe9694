#include "optimise/linear_program.hpp"

#include "simd/vectors.hpp"

namespace hexmend {
namespace {

// Slopes of a model by each of its different nodes: the first of equal ones has the sum, the others none.
struct NodeSlopes {
    V3<double> at[4];
    bool counts[4] = {true, true, true, true};

    NodeSlopes(const std::array<Node, 4> &nodes, const std::array<double, 12> &slopes) {
        for (int k = 0; k < 4; ++k) at[k] = {slopes[3 * k], slopes[3 * k + 1], slopes[3 * k + 2]};
        for (int later = 1; later < 4; ++later)
            for (int earlier = 0; earlier < later; ++earlier)
                if (counts[later] && nodes[earlier] == nodes[later]) at[earlier] += at[later], counts[later] = false;
    }
};

}  // namespace

std::tuple<LongArray, LongArray, OwnedArray<double>> program_rows(const LinearModels &models, Indices index,
                                                                  const NodeDirections &directions,
                                                                  std::int64_t gain_column) {
    const std::size_t count = models.nodes.size();
    std::vector<std::int64_t> start(count + 1);
    auto for_each_node = [&](std::size_t row, const auto &body) {
        const NodeSlopes slopes(models.nodes[row], models.slopes[row]);
        for (int k = 0; k < 4; ++k)
            if (std::int32_t node = index[models.nodes[row][k]]; node >= 0 && slopes.counts[k])
                body(slopes.at[k], directions.first[node], directions.first[node + 1]);
    };
    for (std::size_t row = 0; row < count; ++row) {
        std::int64_t length = 1;
        for_each_node(row, [&](const auto &, auto begin, auto end) { length += end - begin; });
        start[row + 1] = start[row] + length;
    }
    std::vector<std::int64_t> columns(start.back());
    std::vector<double> values(start.back());
    for (std::size_t row = 0; row < count; ++row) {
        std::int64_t at = start[row];
        for_each_node(row, [&](const auto &slope, auto begin, auto end) {
            for (auto direction = begin; direction < end; ++direction, ++at) {
                columns[at] = directions.columns[direction];
                values[at] = -numpy_dot(slope, vector(directions.displacements[direction]));
            }
        });
        columns[at] = gain_column, values[at] = models.gains[row];
    }
    return {{std::move(start)}, {std::move(columns)}, {std::move(values)}};
}

}  // namespace hexmend
