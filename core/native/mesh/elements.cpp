#include "mesh/elements.hpp"

#include <algorithm>
#include <numeric>

#include "energy/tetrahedron.hpp"
#include "simd/simd_hexes.hpp"

namespace hexmend {
namespace {

// Numbers in EDGES of the three edges at each corner tetrahedron's apex.
constexpr auto AT_APEX = [] {
    std::array<std::array<int, 3>, 8> numbers{};
    for (int t = 0; t < 8; ++t)
        for (int k = 0; k < 3; ++k) {
            int a = CORNER_TETRAHEDRA[t][0], b = CORNER_TETRAHEDRA[t][k + 1];
            for (int e = 0; e < 12; ++e)
                if ((EDGES[e][0] == a && EDGES[e][1] == b) || (EDGES[e][0] == b && EDGES[e][1] == a)) numbers[t][k] = e;
        }
    return numbers;
}();

}  // namespace

void measure(Points points, Hexes hexes, std::span<double> q, std::span<double> sigma, std::span<double> jacobian,
             std::span<double> eta) {
    for_each_block<Lanes>(hexes.size(), [&](std::int64_t first, int count) {
        auto x = gather_corners<Lanes>(points, hexes, first, count);
        Lanes squares[12], lengths[12];  // each is of two corner tetrahedra
        unroll<12>([&](auto e) {
            squares[e] = square(x.at[EDGES[e][1]] - x.at[EDGES[e][0]]);
            lengths[e] = sqrt(squares[e]);
        });
        Lanes quality{}, energy{}, lowest = broadcast<Lanes>(INF), worst = broadcast<Lanes>(INF);
        unroll<8>([&](auto t) {
            constexpr auto u = AT_APEX[t][0], v = AT_APEX[t][1], w = AT_APEX[t][2];
            Lanes det = determinant(x.template edges<t>());
            auto number = abs(det) < INF;  // no longer one where products overflow
            auto sound = (det > 0.0) & number;
            Lanes shape = (squares[u] + squares[v] + squares[w]) * power_minus_two_thirds(det) * (1.0 / 3.0);
            energy += sound ? shape : broadcast<Lanes>(INF);         // eta(T), (3.1)
            quality += sound ? 1.0 / shape : broadcast<Lanes>(0.0);  // q(T), (2.8)
            Lanes product = lengths[u] * lengths[v] * lengths[w];
            Lanes scaled = (product > 0.0) & number ? det / product : broadcast<Lanes>(0.0);
            lowest = min(det, lowest);
            worst = min(scaled, worst);
        });
        store(quality * 0.125, first, count, q);  // (2.10)
        store(lowest, first, count, sigma);
        store(worst, first, count, jacobian);
        store(max(energy * 0.125 - 1.0, broadcast<Lanes>(0.0)), first, count, eta);  // (B.20)
    });
}

double mean_edge_length(Points points, Hexes hexes) {
    std::vector<double> totals((hexes.size() + HEXES_PER_CHUNK - 1) / HEXES_PER_CHUNK);
    parallel_chunks(hexes.size(), HEXES_PER_CHUNK, [&](std::int64_t begin, std::int64_t end) {
        double total = 0;
        for (auto first = begin; first < end; first += LANES) {
            int count = static_cast<int>(std::min<std::int64_t>(LANES, end - first));
            auto x = gather_corners<Lanes>(points, hexes, first, count);
            Lanes lengths{};
            for (auto &[from, to] : EDGES) lengths += length(x.at[to] - x.at[from]);
            for (int i = 0; i < count; ++i) total += lengths[i];
        }
        totals[begin / HEXES_PER_CHUNK] = total;
    });
    return hexes.empty() ? 0.0 : std::accumulate(totals.begin(), totals.end(), 0.0) / (12.0 * hexes.size());
}

void corner_determinants(Points points, Hexes hexes, ArrayView<double, 8> sigma) {
    for_each_block<Lanes>(hexes.size(), [&](std::int64_t first, int count) {
        auto x = gather_corners<Lanes>(points, hexes, first, count);
        unroll<8>([&](auto t) {
            Lanes det = determinant(x.template edges<t>());
            for (int i = 0; i < count; ++i) sigma[first + i][t] = det[i];
        });
    });
}

}  // namespace hexmend
