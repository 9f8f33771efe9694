#include "mesh/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "energy/tetrahedron.hpp"
#include "simd/simd_hexes.hpp"

namespace hexmend {
namespace {

// Numbers in EDGES of the three edges at the apex of each corner tetrahedron.
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

// Squared lengths and lengths of the twelve edges, each of which belongs to two corner tetrahedra.
struct EdgeLengths {
    Lanes squares[12], lengths[12];

    explicit EdgeLengths(const Corners<Lanes> &x) {
        unroll<12>([&](auto e) {
            squares[e] = square(x.at[EDGES[e][1]] - x.at[EDGES[e][0]]);
            lengths[e] = sqrt(squares[e]);
        });
    }
};

// Figures of a corner tetrahedron at delta = 0: sigma, (2.9); eta(T), (3.1); q(T) = 1/eta(T), (2.8); and the scaled
// Jacobian sigma/(|u||v||w|).
struct CornerFigures {
    Lanes sigma, eta, q, scaled_jacobian;
};

template <int t>
inline __attribute__((always_inline)) CornerFigures corner_figures(const Corners<Lanes> &x, const EdgeLengths &edges) {
    constexpr auto u = AT_APEX[t][0], v = AT_APEX[t][1], w = AT_APEX[t][2];
    Lanes sigma = determinant(x.edges<t>());
    auto finite = abs(sigma) < INF;  // false where products overflow to INF or NaN
    auto valid = (sigma > 0.0) & finite;
    Lanes eta = (edges.squares[u] + edges.squares[v] + edges.squares[w]) * power_minus_two_thirds(sigma) * (1.0 / 3.0);
    Lanes product = edges.lengths[u] * edges.lengths[v] * edges.lengths[w];
    return {sigma, valid ? eta : broadcast<Lanes>(INF), valid ? 1.0 / eta : broadcast<Lanes>(0.0),
            (product > 0.0) & finite ? sigma / product : broadcast<Lanes>(0.0)};
}

}  // namespace

void measure(Points points, Hexes hexes, std::span<double> q, std::span<double> sigma, std::span<double> jacobian,
             std::span<double> eta) {
    expect(have_rows(hexes.size(), q, sigma, jacobian, eta),
           "q, sigma, jacobian and eta: one for each of hexes is expected");
    for_each_corners<Lanes>(points, hexes, [&](const Corners<Lanes> &x, std::int64_t first, int count) {
        EdgeLengths edges(x);
        Lanes quality{}, energy{}, lowest = broadcast<Lanes>(INF), worst = broadcast<Lanes>(INF);
        unroll<8>([&](auto t) {
            auto corner = corner_figures<t>(x, edges);
            energy += corner.eta;
            quality += corner.q;
            lowest = min(corner.sigma, lowest);
            worst = min(corner.scaled_jacobian, worst);
        });
        store(quality * 0.125, first, count, q);  // (2.10)
        store(lowest, first, count, sigma);
        store(worst, first, count, jacobian);
        store(max(energy * 0.125 - 1.0, broadcast<Lanes>(0.0)), first, count, eta);  // (B.20)
    });
}

void measure_against(Points points, Hexes hexes, const TargetMatrices &target, std::span<double> q,
                     std::span<double> eta) {
    expect(have_rows(hexes.size(), q, eta), "q and eta: one for each of hexes is expected");
    expect_rows(&target, hexes.size());
    for_each_corners<Lanes>(points, hexes, [&](const Corners<Lanes> &x, std::int64_t first, int count) {
        auto scales = scales_of<Lanes>(target, first, count);
        Lanes quality{}, energy{};
        unroll<8>([&](auto t) {
            Lanes corner =
                hexmend::eta<false>(x.template edges<t>(), scales.template columns<t>(), 0, std::true_type{});
            energy += corner;
            quality += corner > 0.0 ? 1.0 / corner : broadcast<Lanes>(0.0);
        });
        Lanes value = hex_energy(energy, 1);
        store(quality * 0.125, first, count, q);
        store(value, first, count, eta);
    });
}

void corner_qualities(Points points, Hexes hexes, ArrayView<double, 8> q) {
    expect(q.size() == hexes.size(), "q: a row for each of hexes is expected");
    for_each_corners<Lanes>(points, hexes, [&](const Corners<Lanes> &x, std::int64_t first, int count) {
        EdgeLengths edges(x);
        unroll<8>([&](auto t) {
            Lanes quality = corner_figures<t>(x, edges).q;
            for (int i = 0; i < count; ++i) q[first + i][t] = quality[i];
        });
    });
}

void corner_jacobians(Points points, Hexes hexes, ArrayView<double, 8> jacobians) {
    expect(jacobians.size() == hexes.size(), "jacobians: a row of each of the hexes is expected");
    for_each_corners<Lanes>(points, hexes, [&](const Corners<Lanes> &x, std::int64_t first, int count) {
        unroll<8>([&](auto t) {
            Lanes value = scaled_jacobian(x.template edges<t>());
            for (int i = 0; i < count; ++i) jacobians[first + i][t] = value[i];
        });
    });
}

void lower_to_edges(Points points, Hexes hexes, std::span<double> lengths) {
    expect(lengths.size() == points.size(), "lengths: one for each of points is expected");
    auto lower = [](double &to, double length) {
        if (length < to || std::isnan(length)) to = length;  // what is no number stays none
    };
    for (const Hex &hex : hexes)
        for (auto [a, b] : EDGES) {
            V3<double> edge = vector(points[hex[b]]) - vector(points[hex[a]]);
            double length = std::sqrt(numpy_dot(edge, edge));
            lower(lengths[hex[a]], length), lower(lengths[hex[b]], length);
        }
}

double mean_edge_length(Points points, Hexes hexes) {
    std::vector<double> totals((hexes.size() + HEXES_PER_CHUNK - 1) / HEXES_PER_CHUNK);
    for_each_block<Lanes>(hexes.size(), [&](std::int64_t first, int count) {
        Lanes lengths = edge_lengths(gather_corners<Lanes>(points, hexes, first, count));
        for (int i = 0; i < count; ++i) totals[first / HEXES_PER_CHUNK] += lengths[i];
    });
    return hexes.empty() ? 0.0 : std::accumulate(totals.begin(), totals.end(), 0.0) / (12.0 * hexes.size());
}

void corner_determinants(Points points, Hexes hexes, ArrayView<double, 8> sigma) {
    expect(sigma.size() == hexes.size(), "sigma: a row for each of hexes is expected");
    for_each_corners<Lanes>(points, hexes, [&](const Corners<Lanes> &x, std::int64_t first, int count) {
        unroll<8>([&](auto t) {
            Lanes det = determinant(x.template edges<t>());
            for (int i = 0; i < count; ++i) sigma[first + i][t] = det[i];
        });
    });
}

}  // namespace hexmend
