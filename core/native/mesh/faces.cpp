#include "mesh/faces.hpp"

#include <numbers>

#include "simd/simd_hexes.hpp"

namespace hexmend {
namespace {

// In degrees, of cosines that rounding may have taken beyond -1 or 1.
void put_angle(const Lanes &cosine, std::int64_t first, int count, std::span<double> angle) {
    Lanes in_range = least(greatest(cosine, all<Lanes>(-1.0)), all<Lanes>(1.0));
    for (int i = 0; i < count; ++i) angle[first + i] = std::acos(in_range[i]) * (180 / std::numbers::pi);
}

// -1 where one of the vectors has no length.
Lanes cosine(const V3<Lanes> &a, const V3<Lanes> &b) {
    Lanes product = length(a) * length(b);
    return ((product > 0.0) & (product < INF)) ? dot(a, b) / product : all<Lanes>(-1.0);
}

}  // namespace

void angles(Points points, Hexes hexes, std::span<double> smallest, std::span<double> largest) {
    blocks_of<Lanes>(hexes.size(), [&](std::int64_t first, int count) {
        auto x = gathered<Lanes>(points, hexes, first, count);
        Lanes low = all<Lanes>(1.0), high = all<Lanes>(-1.0);  // cosines
        unrolled<8>([&](auto t) {                              // the edges from a corner make the angles of three faces
            auto [u, v, w] = x.template edges<t>();
            Lanes a = length(u), b = length(v), c = length(w), product = a * b * c;
            auto sound = (product > 0.0) & (product < INF);
            Lanes one = 1.0 / product;
            Lanes uv = dot(u, v) * c * one, vw = dot(v, w) * a * one, wu = dot(w, u) * b * one;
            // An edge of no length makes every angle.
            low = sound ? least(uv, least(vw, least(wu, low))) : all<Lanes>(-1.0);
            high = sound ? greatest(uv, greatest(vw, greatest(wu, high))) : all<Lanes>(1.0);
        });
        put_angle(high, first, count, smallest);
        put_angle(low, first, count, largest);
    });
}

void warpage(Points points, Hexes hexes, std::span<double> worst) {
    blocks_of<Lanes>(hexes.size(), [&](std::int64_t first, int count) {
        auto x = gathered<Lanes>(points, hexes, first, count);
        Lanes low = all<Lanes>(1.0);
        unrolled<6>([&](auto f) {
            constexpr auto &face = FACES[f];
            auto edge = [&](int k) { return x.at[face[(k + 1) % 4]] - x.at[face[k]]; };
            V3<Lanes> p = edge(0), q = edge(1), r = edge(2), s = edge(3);
            V3<Lanes> n0 = cross(s, p), n1 = cross(p, q), n2 = cross(q, r), n3 = cross(r, s);
            low = least(cosine(n0, n2), least(cosine(n1, n3), low));
        });
        low = greatest(low, all<Lanes>(-1.0));
        put(1.0 - low * low * low, first, count, worst);
    });
}

void volume(Points points, Hexes hexes, std::span<double> enclosed) {
    blocks_of<Lanes>(hexes.size(), [&](std::int64_t first, int count) {
        auto x = from_first_corner(gathered<Lanes>(points, hexes, first, count));
        Lanes sum{};
        unrolled<6>([&](auto f) {
            constexpr auto &face = FACES[f];
            auto &a = x.at[face[0]], &b = x.at[face[1]], &c = x.at[face[2]], &d = x.at[face[3]];
            sum += dot(a + b + c + d, cross(c - a, d - b));
        });
        put(sum * (1.0 / 24), first, count, enclosed);
    });
}

}  // namespace hexmend
