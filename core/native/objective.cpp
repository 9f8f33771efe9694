#include "objective.hpp"

#include "blocks.hpp"
#include "tetrahedron.hpp"

namespace hexmend {
namespace {

using Left = std::span<const std::uint8_t>;

template <bool soft> void energies_of(Points points, Hexes hexes, double delta, Left left_out, std::span<double> eta) {
    blocks_of<Lanes>(hexes.size(), [&](std::int64_t first, int count) {
        auto x = gathered<Lanes>(points, hexes, first, count);
        Counted<Lanes> counted(left_out, first, count);
        Lanes sum{};
        unrolled<8>([&](auto t) {
            auto e = energy<soft>(x.template edges<t>(), delta, counted(t));
            sum += counted(t) ? e.eta() : all<Lanes>(1.0);
        });
        sum = greatest(sum * 0.125 - 1.0, all<Lanes>(0.0));  // (B.20)
        for (int i = 0; i < count; ++i) eta[first + i] = sum[i];
    });
}

// Write a block's vectors at corners, each hex weighted, to the shares of its hexes.
inline void store(const Corners<Lanes> &g, std::int64_t first, int count, Shares shares) {
    alignas(64) double buffer[24][LANES];
    std::memcpy(buffer, &g, sizeof g);
    for (int i = 0; i < count; ++i)
        for (int k = 0; k < 24; ++k) shares[first + i][k] = buffer[k][i];
}

struct BlockWeights {
    Lanes first, second;

    BlockWeights(Lanes sum, double p) {
        Lanes energy = sum * 0.125 - 1.0;
        if (p == 2) {
            energy = greatest(energy, all<Lanes>(0.0));
            first = 2.0 * energy, second = energy >= 0.0 ? all<Lanes>(2.0) : all<Lanes>(0.0);
            second = sum * 0.125 - 1.0 < 0.0 ? all<Lanes>(0.0) : second;
            return;
        }
        for (int i = 0; i < LANES; ++i) {
            auto [one, two] = weights(energy[i], p);
            first[i] = one, second[i] = two;
        }
    }
};

template <bool soft>
void gradient_of(Points points, Hexes hexes, double delta, double p, Left left_out, Shares shares) {
    blocks_of<Lanes>(hexes.size(), [&](std::int64_t first, int count) {
        auto x = gathered<Lanes>(points, hexes, first, count);
        Counted<Lanes> counted(left_out, first, count);
        Corners<Lanes> g;
        Lanes sum{};
        unrolled<8>([&](auto t) {
            auto s = x.template edges<t>();
            auto cof = cofactors(s);
            auto d = derivatives<soft>(s, cof, delta, counted(t));
            sum += counted(t) ? d.eta : all<Lanes>(1.0);
            g.template scatter<t>(gradient(d, s, cof));
        });
        BlockWeights by(sum, p);
        for (auto &corner : g.at) corner = by.first * corner;
        store(g, first, count, shares);
    });
}

template <bool soft>
void product_of(Points points, Hexes hexes, Hexes slots, Points values, double delta, double p, Left left_out,
                Shares shares) {
    blocks_of<Lanes>(hexes.size(), [&](std::int64_t first, int count) {
        auto x = gathered<Lanes>(points, hexes, first, count);
        auto v = gathered_or_zero<Lanes>(values, slots, first, count);
        Counted<Lanes> counted(left_out, first, count);
        Corners<Lanes> g, h;
        Lanes sum{}, slope{};
        unrolled<8>([&](auto t) {
            auto s = x.template edges<t>(), a = v.template edges<t>();
            auto cof = cofactors(s);
            auto d = derivatives<soft>(s, cof, delta, counted(t));
            auto by_s = gradient(d, s, cof);
            sum += counted(t) ? d.eta : all<Lanes>(1.0);
            slope += dot(by_s, a);
            g.template scatter<t>(by_s);
            h.template scatter<t>(product(d, s, cof, a));
        });
        BlockWeights by(sum, p);
        Lanes along = by.second * slope;
        for (int c = 0; c < 8; ++c) h.at[c] = by.first * h.at[c] + along * g.at[c];
        store(h, first, count, shares);
    });
}

}  // namespace

void energies(Points points, Hexes hexes, double delta, Left left_out, std::span<double> eta) {
    (delta > 0 ? energies_of<true> : energies_of<false>)(points, hexes, delta, left_out, eta);
}

void gradient(Points points, Hexes hexes, double delta, double p, Left left_out, Shares shares) {
    (delta > 0 ? gradient_of<true> : gradient_of<false>)(points, hexes, delta, p, left_out, shares);
}

void hessian_product(Points points, Hexes hexes, Hexes slots, Points values, double delta, double p, Left left_out,
                     Shares shares) {
    (delta > 0 ? product_of<true> : product_of<false>)(points, hexes, slots, values, delta, p, left_out, shares);
}

void gather(std::span<const Point> shares, Indices start, Indices corners, Indices nodes, std::span<Point> rows) {
    parallel_chunks(nodes.size(), 4 * CHUNK, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t k = begin; k < end; ++k) {
            Point sum{};
            for (auto s = start[nodes[k]]; s < start[nodes[k] + 1]; ++s)
                for (int j = 0; j < 3; ++j) sum[j] += shares[corners[s]][j];
            rows[k] = sum;
        }
    });
}

}  // namespace hexmend
