// Second derivatives of eta(H)^p by the corners of each hex of a block.
#pragma once

#include "energy/tetrahedron.hpp"
#include "linear/sparsity.hpp"
#include "simd/simd_hexes.hpp"

namespace hexmend {

// Layout of a hex's values: the 3 x 3 blocks of its 28 pairs of corners, by rows; the diagonal blocks of its 8 corners,
// xx xy xz yy yz zz; padding to whole vectors.
constexpr int DIAGONAL_OFFSET = 9 * PAIRS, HEX_VALUES = DIAGONAL_OFFSET + 6 * 8, HEX_STRIDE = (HEX_VALUES + 7) / 8 * 8;

// Values are clamped to this, so that their sums do not overflow single precision.
constexpr double SINGLE_LIMIT = 1e34;

// Sums over the corner tetrahedra of a block of hexes: second derivatives of eta, gradient of eta/8, and eta.
struct HessianSums {
    Lanes at[DIAGONAL_OFFSET];
    Corners<Lanes> g;
    Lanes eta{};

    // Add c q' + p d' + k I + [e]x to the block of corners a and b.
    template <int a, int b>
    void pair(const V3<Lanes> &c, const V3<Lanes> &p, const V3<Lanes> &d, const V3<Lanes> &q, Lanes k,
              const V3<Lanes> &e) {
        Lanes *to = at + 9 * (a < b ? pair_of(a, b) : pair_of(b, a));
        constexpr int xy = a < b ? 1 : 3, xz = a < b ? 2 : 6, yz = a < b ? 5 : 7;
        to[0] += c.x * q.x + p.x * d.x + k;
        to[xy] += c.x * q.y + p.x * d.y - e.z;
        to[xz] += c.x * q.z + p.x * d.z + e.y;
        to[4 - xy] += c.y * q.x + p.y * d.x + e.z;
        to[4] += c.y * q.y + p.y * d.y + k;
        to[yz] += c.y * q.z + p.y * d.z - e.x;
        to[8 - xz] += c.z * q.x + p.z * d.x - e.y;
        to[12 - yz] += c.z * q.y + p.z * d.y + e.x;
        to[8] += c.z * q.z + p.z * d.z + k;
    }
};

// Rows of W^-1 of a kind of cells, with those of its target.
template <class Cell, class Scales> inline M3<Lanes> ideal_rows(const Scales &by) {
    constexpr auto &v = Cell::table.inverse;
    M3<Lanes> columns{{broadcast<Lanes>(v[0][0]), Lanes{}, Lanes{}},
                      {broadcast<Lanes>(v[0][1]), broadcast<Lanes>(v[1][1]), Lanes{}},
                      {broadcast<Lanes>(v[0][2]), broadcast<Lanes>(v[1][2]), broadcast<Lanes>(v[2][2])}};
    const auto [a, b, c] = scale(columns, by);
    return {{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}};
}

// Add eta(T) of corner tetrahedron t, and an eighth of its gradient and second derivatives by its nodes: (B.19),
// corrected as in tetrahedron.hpp.
//
// Let s and c be the columns of S and C that belong to a node (for the apex: minus their sum) and p = mixed s + half c.
// The block of two nodes is c p' + p c' plus the terms of d2 sigma and (V, W).
//
// With a target the columns of S W^-1 that belong to a node are scaled once more, by its derivative. With `Inverse` it
// is q(T) = 1/eta(T) instead.
template <class Cell, bool soft, int t, class Scales, class Function = Itself>
__attribute__((noinline)) void add_tetrahedron(const Corners<Lanes> &x, const Scales &scales, double delta,
                                               Bits counted, HessianSums &sums, Function function = {}) {
    constexpr auto &n = Cell::table.corner_tetrahedra[t];
    const auto by = scales.template columns<Cell, t>();
    auto edges = x.shape<Cell, t>();
    const auto &s = scale(edges, by);
    auto c = cofactors(s);
    auto d = function(derivatives<soft>(edges, by, s, c, delta, counted));
    sums.eta += counted ? d.eta : broadcast<Lanes>(1.0);
    sums.g.scatter<Cell, t>(by_edges<Cell>(scale(gradient<Lanes>(d, s, c), by)));
    M3<Lanes> p{d.mixed * s.u + d.half * c.u, d.mixed * s.v + d.half * c.v, d.mixed * s.w + d.half * c.w};
    if constexpr (Scales::scaled) c = scale(c, by), p = scale(p, by);
    c = by_edges<Cell>(c), p = by_edges<Cell>(p);
    V3<Lanes> ca = -(c.u + c.v + c.w), pa = -(p.u + p.v + p.w);
    V3<Lanes> u = d.c * s.u, v = d.c * s.v, w = d.c * s.w;
    Lanes ku = -d.k, kv = -d.k, kw = -d.k, kuv{}, kuw{}, kvw{};
    if constexpr (!Cell::is_cube) {
        auto [eu, ev, ew] = x.edges<Cell, t>();
        Lanes twist = scale(d.c * Cell::inverse_determinant, by);
        u = twist * eu, v = twist * ev, w = twist * ew;
        // The edges of unit tetrahedra as rows of W^-1 with the target: their products are those of (V, W).
        auto [ru, rv, rw] = ideal_rows<Cell>(by);
        auto k = [&](const V3<Lanes> &a, const V3<Lanes> &b) { return d.k * dot(a, b); };
        kuv = k(ru, rv), kuw = k(ru, rw), kvw = k(rv, rw);
        ku = -k(ru, ru + rv + rw), kv = -k(rv, ru + rv + rw), kw = -k(rw, ru + rv + rw);
    } else if constexpr (Scales::scaled) {
        u = (by.v * by.w) * u, v = (by.w * by.u) * v, w = (by.u * by.v) * w;
        ku *= by.u * by.u, kv *= by.v * by.v, kw *= by.w * by.w;
    }
    sums.pair<n[0], n[1]>(ca, pa, c.u, p.u, ku, w - v);
    sums.pair<n[0], n[2]>(ca, pa, c.v, p.v, kv, u - w);
    sums.pair<n[0], n[3]>(ca, pa, c.w, p.w, kw, v - u);
    sums.pair<n[1], n[2]>(c.u, p.u, c.v, p.v, kuv, w);
    sums.pair<n[1], n[3]>(c.u, p.u, c.w, p.w, kuw, -v);
    sums.pair<n[2], n[3]>(c.v, p.v, c.w, p.w, kvw, u);
    if constexpr (Function::has_squares) {  // d.squares times s s'
        const auto [su, sv, sw] = by_edges<Cell>(scale(s, by));
        V3<Lanes> none{};
        V3<Lanes> qu = d.squares * su, qv = d.squares * sv, qw = d.squares * sw, apex = -(su + sv + sw);
        sums.pair<n[0], n[1]>(apex, none, none, qu, Lanes{}, none);
        sums.pair<n[0], n[2]>(apex, none, none, qv, Lanes{}, none);
        sums.pair<n[0], n[3]>(apex, none, none, qw, Lanes{}, none);
        sums.pair<n[1], n[2]>(su, none, none, qv, Lanes{}, none);
        sums.pair<n[1], n[3]>(su, none, none, qw, Lanes{}, none);
        sums.pair<n[2], n[3]>(sv, none, none, qw, Lanes{}, none);
    }
}

// Transpose eight vectors into eight consecutive numbers for each lane, at out[lane][row].
inline void store(const Lanes (&rows)[8], int row, float (*out)[HEX_STRIDE]) {
#if defined(__AVX512F__)
    typedef float Eight __attribute__((vector_size(32)));
    Eight a[8], b[8];
    for (int k = 0; k < 8; ++k) a[k] = _mm512_cvtpd_ps(rows[k]);
    for (int k = 0; k < 8; k += 2) {
        b[k] = __builtin_shufflevector(a[k], a[k + 1], 0, 8, 1, 9, 4, 12, 5, 13);
        b[k + 1] = __builtin_shufflevector(a[k], a[k + 1], 2, 10, 3, 11, 6, 14, 7, 15);
    }
    for (int k = 0; k < 8; k += 4)
        for (int j = 0; j < 2; ++j) {
            a[k + 2 * j] = __builtin_shufflevector(b[k + j], b[k + j + 2], 0, 1, 8, 9, 4, 5, 12, 13);
            a[k + 2 * j + 1] = __builtin_shufflevector(b[k + j], b[k + j + 2], 2, 3, 10, 11, 6, 7, 14, 15);
        }
    for (int k = 0; k < 4; ++k) {
        Eight low = __builtin_shufflevector(a[k], a[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
        Eight high = __builtin_shufflevector(a[k], a[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
        std::memcpy(out[k] + row, &low, sizeof low);
        std::memcpy(out[k + 4] + row, &high, sizeof high);
    }
#else
    for (int k = 0; k < 8; ++k)
        for (int i = 0; i < LANES; ++i) out[i][row + k] = static_cast<float>(rows[k][i]);
#endif
}

inline void store(const Lanes (&rows)[8], int row, double (*out)[HEX_STRIDE]) {
    for (int k = 0; k < 8; ++k)
        for (int i = 0; i < LANES; ++i) out[i][row + k] = rows[k][i];
}

inline Lanes clamp(Lanes value) {
    return min(broadcast<Lanes>(SINGLE_LIMIT), max(broadcast<Lanes>(-SINGLE_LIMIT), value));
}

// Write first * values + second * g g', clamped, for each hex of the block: the second derivatives of a function of
// eta(H) with these derivatives.
//
// Translating a hex does not change its energy: the blocks of each corner sum to zero, which gives the diagonal ones.
template <class Real> void weigh_hessian(const HessianSums &sums, Lanes first, Lanes second, Real (*out)[HEX_STRIDE]) {
    Lanes g[24], h[24], own[48] = {}, rows[8];
    std::memcpy(g, &sums.g, sizeof g);
    for (int k = 0; k < 24; ++k) h[k] = second * g[k];
    int row = 0;
    auto next = [&](Lanes value) __attribute__((always_inline)) {
        rows[row % 8] = value;
        if (++row % 8 == 0) store(rows, row - 8, out);
    };
    for (int a = 0; a < 8; ++a)
        for (int b = a + 1; b < 8; ++b)
            unroll<9>([&](auto at) {
                constexpr int i = at / 3, j = at % 3;
                Lanes value = clamp(first * sums.at[row] + h[3 * a + i] * g[3 * b + j]);
                // Entries xx xy xz yy yz zz of the block for a, of its transpose for b.
                if constexpr (i <= j) own[6 * a + i * (5 - i) / 2 + j] -= value;
                if constexpr (i >= j) own[6 * b + j * (5 - j) / 2 + i] -= value;
                next(value);
            });
    for (Lanes value : own) next(clamp(value));
    while (row % 8) next(Lanes{});
}

// Of eta(H)^p.
template <class Cell, class Real>
void weigh_hessian(const HessianSums &sums, ObjectiveNorm norm, Real (*out)[HEX_STRIDE]) {
    auto by = power_derivatives_of<Cell>(sums.eta, norm.offset, norm.p);
    weigh_hessian<Real>(sums, by.first, by.second, out);
}

}  // namespace hexmend
