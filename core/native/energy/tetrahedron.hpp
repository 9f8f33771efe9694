// The formulas of a corner tetrahedron, S = [u, v, w]: eta(T), its first and its second derivative.
//
// With V and W directions of S, C the cofactors of S, so that d sigma(V) = (C, V), r = sqrt(sigma^2 + 4 delta^2) and
// f = h^(-2/3)/3, so that eta = f |S|^2:
//
//     d eta(V)    = 2 f [ (V, S) - |S|^2 (C, V)/(3 r) ]                                                       (B.3)
//     d2 eta(V,W) = 2 f [ (V, W) - 2/(3 r) ((V, S)(C, W) + (C, V)(W, S))
//                         - |S|^2/(3 r) d2 sigma(V, W) + |S|^2/(3 r^2) (2/3 + sigma/r) (C, V)(C, W) ]
//
// The second is (B.19), corrected, with (B.3) substituted for d eta d eta/eta: the terms in 1/|S|^2 cancel, and nothing
// is divided by eta, |S| or sigma, so that collapsed and inverted tetrahedra are no special case while delta > 0.
//
// For a cell that is no hex, and with a target, S is S W^-1 throughout (hexahedron.hpp, column_scales.hpp). With a
// target, next to the shape the size counts: weight g(h), g(h) = (h + 1/h)/2 - 1, which is convex in sigma for any
// delta. With h' = h/r and h'' = 2 delta^2/r^3 its derivatives by sigma are (h - 1/h)/(2 r) and 1/(h r^2) + (1 - 1/h^2)
// delta^2/r^3.
//
// A tetrahedron that is not `counted` is omitted: f, to which energy and derivatives are proportional, is 0. The
// template parameter `soft` is true for delta > 0.
#pragma once

#include "energy/column_scales.hpp"
#include "simd/vectors.hpp"

namespace hexmend {

constexpr double MIN_NORMAL = std::numeric_limits<double>::min(), MAX_FINITE = std::numeric_limits<double>::max();

// h^(-2/3); INF for h below the smallest normal float, for h <= 0 and for NaN.
//
// A first guess q from the upper bits of h is improved twice by the series of q (1 - y)^(-1/3), y = 1 - h^2 q^3, up to
// its fourth term: the relative error falls from 0.04 to 3e-5 and then to rounding.
template <class T> inline T power_minus_two_thirds(T h) {
    using B = bits_of<T>;
    // The upper half of the bits of 2^52 (1023 + 1023 * 2/3 - 0.0446): gives the bits of h^(-2/3) to 4 %.
    constexpr double MAGIC = static_cast<double>(7678276173719137280LL >> 32);
    // The lower bits of a float between 2^52 and 2^53 are those of an integer: converts between the two.
    constexpr double WHOLE = 0x1p52;
    constexpr std::int64_t WHOLE_BITS = 0x4330000000000000LL;
    T upper = bit_cast<T>((bit_cast<B>(h) >> 32 & 0xffffffffLL) | WHOLE_BITS) - WHOLE;
    T q = bit_cast<T>(bit_cast<B>((MAGIC + WHOLE) - upper * (2.0 / 3.0)) << 32);
    for (int i = 0; i < 2; ++i) {
        T cube_root = h * q;  // neither it nor its square overflows
        T y = 1.0 - cube_root * cube_root * q;
        q += q * y * (1.0 / 3.0 + y * (2.0 / 9.0 + y * (14.0 / 81.0)));
    }
    q = h >= MIN_NORMAL ? q : broadcast<T>(INF);
    return h > MAX_FINITE ? broadcast<T>(0.0) : q;
}

// eta(H) from the sum of its eta(T), each of which has this share, (B.20). With delta > 0 the value may fall below 0,
// which counts as 0; NaN, from coinciding or overflowing corners, counts as INF.
template <class T> inline T cell_energy(T sum, auto share, double offset) {
    T energy = sum * share - offset;
    return energy > 0.0 ? energy : energy <= 0.0 ? broadcast<T>(0.0) : broadcast<T>(INF);
}

// Scaled Jacobian sigma/(|u||v||w|) over that of the ideal cell; -1 where an edge has no length.
template <class Cell, class T> inline T scaled_jacobian(const M3<T> &edges) {
    T lengths = length(edges.u) * length(edges.v) * length(edges.w);
    T ratio = determinant(edges) / lengths;
    if constexpr (!Cell::is_cube) ratio = Cell::inverse_determinant * ratio;
    return lengths > 0.0 ? ratio : broadcast<T>(-1.0);
}

// Result of `barrier`.
template <class T> struct Barrier {
    T h, r;
};

// h(sigma) of (3.2) and r = sqrt(sigma^2 + 4 delta^2). For sigma < 0 it is 2 delta^2/(r - sigma), the same number
// without cancellation. For delta = 0 neither root nor quotient is needed, and sigma^2 may overflow.
template <bool soft, class T> inline Barrier<T> barrier(T sigma, double delta) {
    if constexpr (!soft) return {max(sigma, broadcast<T>(0.0)), abs(sigma)};
    T r = sqrt(sigma * sigma + 4 * delta * delta);
    T u = abs(sigma) + r;
    return {sigma >= 0.0 ? 0.5 * u : 2 * delta * delta / u, r};
}

// eta(T) in its factors: f = h^(-2/3)/3 and square = |S|^2.
template <class T> struct Energy {
    T f, square, sigma, r;
    T eta() const { return f * square; }  // (3.1)
};

template <bool soft, class T> inline Energy<T> energy_of(const M3<T> &s, T sigma, double delta, auto counted) {
    auto [h, r] = barrier<soft>(sigma, delta);
    T f = power_minus_two_thirds(h) * (1.0 / 3.0);
    return {counted ? f : broadcast<T>(0.0), square(s), sigma, r};
}

// The size's share of the energy of a tetrahedron, weight g(h), and its derivatives by sigma.
template <class T> struct SizeTerm {
    T value{}, slope{}, curvature{};
};

template <bool soft, class T> inline SizeTerm<T> size_term(T sigma, double delta, double weight) {
    if (weight == 0) return {};
    auto [h, r] = barrier<soft>(sigma, delta);
    T over_h = 1.0 / h, over_r = 1.0 / r;
    T curvature = over_h * over_r * over_r;
    if constexpr (soft) curvature += (1.0 - over_h * over_h) * (delta * over_r) * (delta * over_r) * over_r;
    return {weight * (0.5 * (h + over_h) - 1.0), (0.5 * weight) * (h - over_h) * over_r, weight * curvature};
}

// eta(T) with S = edges W^-1, and the size's share; 1, as of a perfect one, where it is not counted.
template <bool soft, class T, class Scales>
inline T eta(const M3<T> &edges, const Scales &scales, double delta, auto counted) {
    T sigma = scale(determinant(edges), scales);
    T value = energy_of<soft>(scale(edges, scales), sigma, delta, counted).eta();
    if constexpr (Scales::scaled) value += size_term<soft>(sigma, delta, scales.size_weight).value;
    return counted ? value : broadcast<T>(1.0);
}

// Coefficients of the first and second derivatives of eta/8; the mean of eight eta is eta(H).
//
// The gradient is k S - c C. The second derivative is k (V, W) - c d2 sigma(V, W) + (C, V)(P, W) + (P, V)(C, W) with
// P = mixed S + half C.
template <class T> struct Derivatives {
    T eta, k, c, mixed, half;
};

// Functions of eta whose derivatives are wanted in its place: eta itself.
struct Itself {
    static constexpr bool has_squares = false;
    template <class T> Derivatives<T> operator()(const Derivatives<T> &d) const { return d; }
};

// Derivatives of q(T)/8 in the same form, with `squares` (S, V)(S, W) in the second.
template <class T> struct InverseDerivatives : Derivatives<T> {
    T squares;
};

// q = 1/eta: q' = -q^2 eta', q'' = -q^2 eta'' + 2 q^3 eta' eta'^T, where the derivatives given are those of eta/8.
struct Inverse {
    static constexpr bool has_squares = true;
    template <class T> InverseDerivatives<T> operator()(const Derivatives<T> &d) const {
        T q = d.eta > 0.0 ? 1.0 / d.eta : broadcast<T>(0.0);  // 0 where it is not counted
        T square = q * q, outer = 16.0 * square * q;
        return {{q, -square * d.k, -square * d.c, -square * d.mixed - outer * d.k * d.c,
                 -square * d.half + 0.5 * outer * d.c * d.c},
                outer * d.k * d.k};
    }
};

// Of a tetrahedron with these edges; S = edges W^-1 and its cofactors.
template <bool soft, class T, class Scales>
inline Derivatives<T> derivatives(const M3<T> &edges, const Scales &scales, const M3<T> &s, const M3<T> &cof,
                                  double delta, auto counted) {
    // For delta = 0 the sign of sigma decides: use the determinant that all kernels share.
    T sigma;
    if constexpr (soft) sigma = dot(s.u, cof.u);
    else if constexpr (Scales::scaled) sigma = scale(determinant(edges), scales);
    else sigma = determinant(s);
    auto e = energy_of<soft>(s, sigma, delta, counted);
    T over_r = counted ? 1.0 / e.r : broadcast<T>(0.0);
    T k = 0.25 * e.f, c = e.eta() * over_r * (1.0 / 12.0);
    Derivatives<T> d{e.eta(), k, c, (-2.0 / 3.0) * k * over_r, c * over_r * (1.0 / 3.0 + 0.5 * sigma * over_r)};
    if constexpr (Scales::scaled) {
        if (scales.size_weight != 0) {
            auto size = size_term<soft>(sigma, delta, scales.size_weight);
            d.eta += size.value;
            d.c -= counted ? 0.125 * size.slope : broadcast<T>(0.0);
            d.half += counted ? 0.0625 * size.curvature : broadcast<T>(0.0);
        }
    }
    return d;
}

// The gradient of eta/8 by the columns of S: (B.3).
template <class T> inline M3<T> gradient(const Derivatives<T> &d, const M3<T> &s, const M3<T> &cof) {
    return {d.k * s.u - d.c * cof.u, d.k * s.v - d.c * cof.v, d.k * s.w - d.c * cof.w};
}

// Components of a direction A: (A, S) and (A, C).
template <class T> struct DirectionalTerms {
    T s, c;

    // d eta(A)/8, (B.3).
    T slope(const Derivatives<T> &d) const { return d.k * s - d.c * c; }
};

// Second derivative of eta/8 along A, by the columns of S: (B.19).
template <class T>
inline M3<T> product(const Derivatives<T> &d, const M3<T> &s, const M3<T> &cof, const M3<T> &a,
                     const DirectionalTerms<T> &along) {
    T p = d.mixed * along.c;                           // coefficient of S
    T q = d.mixed * along.s + 2.0 * d.half * along.c;  // coefficient of C
    // The columns of dC are av x w + v x aw and its cyclic permutations.
    return {
        p * s.u + q * cof.u + d.k * a.u - d.c * (cross(a.v, s.w) + cross(s.v, a.w)),
        p * s.v + q * cof.v + d.k * a.v - d.c * (cross(a.w, s.u) + cross(s.w, a.u)),
        p * s.w + q * cof.w + d.k * a.w - d.c * (cross(a.u, s.v) + cross(s.u, a.v)),
    };
}

}  // namespace hexmend
