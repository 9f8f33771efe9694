#include "mesh/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "energy/tetrahedron.hpp"
#include "simd/simd_hexes.hpp"

namespace hexmend {
namespace {

// Numbers among the edges of a kind of cells of the three edges at the apex of each corner tetrahedron.
template <class Cell>
constexpr auto AT_APEX = [] {
    constexpr auto &edges = Cell::table.edge_ends;
    std::array<std::array<int, 3>, 8> numbers{};
    for (int t = 0; t < Cell::corners; ++t)
        for (int k = 0; k < 3; ++k) {
            int a = Cell::table.corner_tetrahedra[t][0], b = Cell::table.corner_tetrahedra[t][k + 1];
            for (int e = 0; e < Cell::table.edges; ++e)
                if ((edges[e][0] == a && edges[e][1] == b) || (edges[e][0] == b && edges[e][1] == a)) numbers[t][k] = e;
        }
    return numbers;
}();

// Squared lengths and lengths of the edges, each of which belongs to several corner tetrahedra.
template <class Cell> struct EdgeLengths {
    Lanes squares[Cell::table.edges], lengths[Cell::table.edges];

    explicit EdgeLengths(const Corners<Lanes> &x) {
        unroll<Cell::table.edges>([&](auto e) {
            constexpr auto &ends = Cell::table.edge_ends[e];
            squares[e] = square(x.at[ends[1]] - x.at[ends[0]]);
            lengths[e] = sqrt(squares[e]);
        });
    }
};

// Figures of a corner tetrahedron at delta = 0: sigma, (2.9); eta(T), (3.1); q(T) = 1/eta(T), (2.8); and the scaled
// Jacobian sigma/(|u||v||w|), over that of the ideal cell.
struct CornerFigures {
    Lanes sigma, eta, q, scaled_jacobian;
};

template <class Cell, int t>
inline __attribute__((always_inline)) CornerFigures corner_figures(const Corners<Lanes> &x,
                                                                   const EdgeLengths<Cell> &edges) {
    constexpr auto u = AT_APEX<Cell>[t][0], v = AT_APEX<Cell>[t][1], w = AT_APEX<Cell>[t][2];
    auto s = x.shape<Cell, t>();
    Lanes sigma = determinant(s), squares = edges.squares[u] + edges.squares[v] + edges.squares[w];
    if constexpr (!Cell::is_cube) squares = square(s);
    auto finite = abs(sigma) < INF;  // false where products overflow to INF or NaN
    auto valid = (sigma > 0.0) & finite;
    Lanes eta = squares * power_minus_two_thirds(sigma) * (1.0 / 3.0);
    Lanes product = edges.lengths[u] * edges.lengths[v] * edges.lengths[w];
    // sigma is det S over the determinant of the ideal edges, all of them of length 1: the scaled Jacobian's own ratio.
    return {sigma, valid ? eta : broadcast<Lanes>(INF), valid ? 1.0 / eta : broadcast<Lanes>(0.0),
            (product > 0.0) & finite ? sigma / product : broadcast<Lanes>(0.0)};
}

// Write the value of a corner; that of the first one stands in the place of corners that a cell does not have.
template <class Cell, int t>
void put_corner(const Lanes &value, std::int64_t first, int count, ArrayView<double, 8> values) {
    for (int i = 0; i < count; ++i) {
        values[first + i][t] = value[i];
        if constexpr (t == 0)
            for (int k = Cell::corners; k < 8; ++k) values[first + i][k] = value[i];
    }
}

}  // namespace

void measure(Points points, Hexes hexes, std::span<double> q, std::span<double> sigma, std::span<double> jacobian,
             std::span<double> eta) {
    expect(have_rows(hexes.size(), q, sigma, jacobian, eta),
           "q, sigma, jacobian and eta: one for each of hexes is expected");
    for_each_corners<Lanes>(points, hexes, [&](auto cell, const Corners<Lanes> &x, std::int64_t first, int count) {
        using Cell = decltype(cell);
        EdgeLengths<Cell> edges(x);
        Lanes quality{}, energy{}, lowest = broadcast<Lanes>(INF), worst = broadcast<Lanes>(INF);
        unroll<Cell::corners>([&](auto t) {
            auto corner = corner_figures<Cell, t>(x, edges);
            energy += corner.eta;
            quality += corner.q;
            lowest = min(corner.sigma, lowest);
            worst = min(corner.scaled_jacobian, worst);
        });
        store(quality * Cell::share, first, count, q);  // (2.10)
        store(lowest, first, count, sigma);
        store(worst, first, count, jacobian);
        store(max(energy * Cell::share - 1.0, broadcast<Lanes>(0.0)), first, count, eta);  // (B.20)
    });
}

void measure_against(Points points, Hexes hexes, const TargetMatrices &target, std::span<double> q,
                     std::span<double> eta) {
    expect(have_rows(hexes.size(), q, eta), "q and eta: one for each of hexes is expected");
    expect_rows(&target, hexes.size());
    for_each_corners<Lanes>(points, hexes, [&](auto cell, const Corners<Lanes> &x, std::int64_t first, int count) {
        using Cell = decltype(cell);
        auto scales = scales_of<Lanes>(target, first, count);
        Lanes quality{}, energy{};
        unroll<Cell::corners>([&](auto t) {
            Lanes corner = hexmend::eta<false>(x.template shape<Cell, t>(), scales.template columns<Cell, t>(), 0,
                                               std::true_type{});
            energy += corner;
            quality += corner > 0.0 ? 1.0 / corner : broadcast<Lanes>(0.0);
        });
        Lanes value = cell_energy(energy, Cell::share, 1);
        store(quality * Cell::share, first, count, q);
        store(value, first, count, eta);
    });
}

void corner_qualities(Points points, Hexes hexes, ArrayView<double, 8> q) {
    expect(q.size() == hexes.size(), "q: a row for each of hexes is expected");
    for_each_corners<Lanes>(points, hexes, [&](auto cell, const Corners<Lanes> &x, std::int64_t first, int count) {
        using Cell = decltype(cell);
        EdgeLengths<Cell> edges(x);
        unroll<Cell::corners>([&](auto t) {
            Lanes quality = corner_figures<Cell, t>(x, edges).q;
            put_corner<Cell, t>(quality, first, count, q);
        });
    });
}

void corner_jacobians(Points points, Hexes hexes, ArrayView<double, 8> jacobians) {
    expect(jacobians.size() == hexes.size(), "jacobians: a row of each of the hexes is expected");
    for_each_corners<Lanes>(points, hexes, [&](auto cell, const Corners<Lanes> &x, std::int64_t first, int count) {
        using Cell = decltype(cell);
        unroll<Cell::corners>([&](auto t) {
            Lanes value = scaled_jacobian<Cell>(x.template edges<Cell, t>());
            put_corner<Cell, t>(value, first, count, jacobians);
        });
    });
}

void lower_to_edges(Points points, Hexes hexes, std::span<double> lengths) {
    expect(lengths.size() == points.size(), "lengths: one for each of points is expected");
    auto lower = [](double &to, double length) {
        if (length < to || std::isnan(length)) to = length;  // what is no number stays none
    };
    for (const Hex &hex : hexes)
        for (int e = 0; e < table_of(hex).edges; ++e) {
            auto [a, b] = table_of(hex).edge_ends[e];
            V3<double> edge = vector(points[hex[b]]) - vector(points[hex[a]]);
            double length = std::sqrt(numpy_dot(edge, edge));
            lower(lengths[hex[a]], length), lower(lengths[hex[b]], length);
        }
}

double mean_edge_length(Points points, Hexes hexes) {
    std::vector<double> totals((hexes.size() + HEXES_PER_CHUNK - 1) / HEXES_PER_CHUNK), edges(totals.size());
    for_each_block<Lanes>(hexes, [&](auto cell, std::int64_t first, int count) {
        using Cell = decltype(cell);
        Lanes lengths = edge_lengths<Cell>(gather_corners<Lanes>(points, hexes, first, count));
        for (int i = 0; i < count; ++i) totals[first / HEXES_PER_CHUNK] += lengths[i];
        edges[first / HEXES_PER_CHUNK] += Cell::table.edges * count;
    });
    auto sum = [](const std::vector<double> &parts) { return std::accumulate(parts.begin(), parts.end(), 0.0); };
    return hexes.empty() ? 0.0 : sum(totals) / sum(edges);
}

void corner_determinants(Points points, Hexes hexes, ArrayView<double, 8> sigma) {
    expect(sigma.size() == hexes.size(), "sigma: a row for each of hexes is expected");
    for_each_corners<Lanes>(points, hexes, [&](auto cell, const Corners<Lanes> &x, std::int64_t first, int count) {
        using Cell = decltype(cell);
        unroll<Cell::corners>([&](auto t) {
            Lanes det = determinant(x.template shape<Cell, t>());
            put_corner<Cell, t>(det, first, count, sigma);
        });
    });
}

}  // namespace hexmend
