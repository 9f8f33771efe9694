// The loops of `objective`: blocks of cells for T = Lanes, one cell after another for T = double.
#pragma once

#include "energy/objective.hpp"
#include "energy/tetrahedron.hpp"
#include "simd/simd_hexes.hpp"

namespace hexmend {

template <class T>
void energies_in(Points points, Hexes hexes, double delta, double offset, OmittedCorners omitted, std::span<double> eta,
                 const TargetMatrices *matrices) {
    expect(have_rows(hexes.size(), omitted, eta), "omitted and eta: one for each hex is expected");
    expect_rows(matrices, hexes.size());
    with_cases(matrices, delta, [&](auto soft, const auto &target) {
        for_each_block<T>(hexes, [&](auto cell, std::int64_t first, int count) {
            using Cell = decltype(cell);
            auto x = gather_corners<T>(points, hexes, first, count);
            auto scales = scales_of<T>(target, first, count);
            T sum{};
            with_corner_mask<T>(omitted, first, count, [&](auto counted) {
                unroll<Cell::corners>([&](auto t) {
                    sum += hexmend::eta<soft>(x.template shape<Cell, t>(), scales.template columns<Cell, t>(), delta,
                                              counted(t));
                });
            });
            sum = cell_energy(sum, Cell::share, offset);
            for (int i = 0; i < count; ++i) eta[first + i] = lane(sum, i);
        });
    });
}

template <class T>
void gradient_in(Points points, Hexes hexes, double delta, ObjectiveNorm norm, OmittedCorners omitted,
                 CornerVectors shares, const TargetMatrices *matrices) {
    expect(have_rows(hexes.size(), omitted, shares), "omitted and shares: one for each hex is expected");
    expect_rows(matrices, hexes.size());
    with_cases(matrices, delta, [&](auto soft, const auto &target) {
        for_each_block<T>(hexes, [&](auto cell, std::int64_t first, int count) {
            using Cell = decltype(cell);
            auto x = gather_corners<T>(points, hexes, first, count);
            auto scales = scales_of<T>(target, first, count);
            CornerMask<T> counted(omitted, first, count);
            Corners<T> g;
            T sum{};
            unroll<Cell::corners>([&](auto t) {
                auto edges = x.template shape<Cell, t>();
                auto by = scales.template columns<Cell, t>();
                const auto &s = scale(edges, by);
                auto cof = cofactors(s);
                auto d = derivatives<soft>(edges, by, s, cof, delta, counted(t));
                sum += counted(t) ? d.eta : broadcast<T>(1.0);
                g.template scatter<Cell, t>(by_edges<Cell>(scale(gradient(d, s, cof), by)));
            });
            auto by = power_derivatives_of<Cell>(sum, norm.offset, norm.p);
            for (auto &corner : g.at) corner = by.first * corner;
            store(g, first, count, shares);
        });
    });
}

template <class T>
void hessian_product_in(Points points, Hexes hexes, Hexes slots, Points values, double delta, ObjectiveNorm norm,
                        OmittedCorners omitted, CornerVectors shares, const TargetMatrices *matrices) {
    expect(have_rows(hexes.size(), omitted, slots, shares), "omitted, slots and shares: one for each hex is expected");
    expect_rows(matrices, hexes.size());
    with_cases(matrices, delta, [&](auto soft, const auto &target) {
        for_each_block<T>(hexes, [&](auto cell, std::int64_t first, int count) {
            using Cell = decltype(cell);
            auto x = gather_corners<T>(points, hexes, first, count);
            auto v = gather_corners_or_zero<T>(values, slots, first, count);
            auto scales = scales_of<T>(target, first, count);
            CornerMask<T> counted(omitted, first, count);
            Corners<T> g, h;
            T sum{}, slope{};
            unroll<Cell::corners>([&](auto t) {
                auto edges = x.template shape<Cell, t>();
                auto by = scales.template columns<Cell, t>();
                auto directions = v.template shape<Cell, t>();
                const auto &s = scale(edges, by), &a = scale(directions, by);
                auto cof = cofactors(s);
                auto d = derivatives<soft>(edges, by, s, cof, delta, counted(t));
                DirectionalTerms<T> along{dot(a, s), dot(a, cof)};
                sum += counted(t) ? d.eta : broadcast<T>(1.0);
                slope += along.slope(d);
                g.template scatter<Cell, t>(by_edges<Cell>(scale(gradient(d, s, cof), by)));
                h.template scatter<Cell, t>(by_edges<Cell>(scale(product(d, s, cof, a, along), by)));
            });
            auto by = power_derivatives_of<Cell>(sum, norm.offset, norm.p);
            T along = by.second * slope;
            for (int c = 0; c < 8; ++c) h.at[c] = by.first * h.at[c] + along * g.at[c];
            store(h, first, count, shares);
        });
    });
}

}  // namespace hexmend
