#include "mesh/metrics.hpp"

#include <numbers>

#include "simd/simd_hexes.hpp"

namespace hexmend {
namespace {

// Write angles in degrees. Rounding may have moved the cosines out of [-1, 1].
void put_angle(const Lanes &cosine, std::int64_t first, int count, std::span<double> angle) {
    Lanes in_range = min(max(cosine, broadcast<Lanes>(-1.0)), broadcast<Lanes>(1.0));
    for (int i = 0; i < count; ++i) angle[first + i] = std::acos(in_range[i]) * (180 / std::numbers::pi);
}

// Cosine of the angle of two vectors; -1 where one has no length.
Lanes cosine(const V3<Lanes> &a, const V3<Lanes> &b) {
    Lanes product = length(a) * length(b);
    return ((product > 0.0) & (product < INF)) ? dot(a, b) / product : broadcast<Lanes>(-1.0);
}

}  // namespace

void angles(Points points, Hexes hexes, std::span<double> smallest, std::span<double> largest) {
    expect(have_rows(hexes.size(), smallest, largest), "smallest and largest: one for each of hexes is expected");
    for_each_corners<Lanes>(points, hexes, [&](auto cell, const Corners<Lanes> &x, std::int64_t first, int count) {
        using Cell = decltype(cell);
        Lanes low = broadcast<Lanes>(1.0), high = broadcast<Lanes>(-1.0);  // cosines
        if constexpr (!Cell::is_cube) {
            unroll<Cell::table.faces>([&](auto f) {
                constexpr auto &face = Cell::table.face_nodes[f];
                constexpr int corners = face[2] == face[3] ? 3 : 4;
                unroll<corners>([&](auto k) {
                    auto &at = x.at[face[k]];
                    Lanes c = cosine(x.at[face[(k + 1) % corners]] - at, x.at[face[(k + corners - 1) % corners]] - at);
                    low = min(c, low), high = max(c, high);
                });
            });
        } else
            unroll<8>([&](auto t) {  // the edges from a corner make the angles of three faces
                auto [u, v, w] = x.template edges<t>();
                Lanes a = length(u), b = length(v), c = length(w), product = a * b * c;
                auto valid = (product > 0.0) & (product < INF);
                Lanes one = 1.0 / product;
                Lanes uv = dot(u, v) * c * one, vw = dot(v, w) * a * one, wu = dot(w, u) * b * one;
                // The angle at an edge of no length is undefined: count it as the worst at either end.
                low = valid ? min(uv, min(vw, min(wu, low))) : broadcast<Lanes>(-1.0);
                high = valid ? max(uv, max(vw, max(wu, high))) : broadcast<Lanes>(1.0);
            });
        put_angle(high, first, count, smallest);
        put_angle(low, first, count, largest);
    });
}

void warpage(Points points, Hexes hexes, std::span<double> worst) {
    expect(worst.size() == hexes.size(), "worst: one for each of hexes is expected");
    for_each_corners<Lanes>(points, hexes, [&](auto cell, const Corners<Lanes> &x, std::int64_t first, int count) {
        using Cell = decltype(cell);
        Lanes low = broadcast<Lanes>(1.0);
        unroll<Cell::table.faces>([&](auto f) {
            constexpr auto &face = Cell::table.face_nodes[f];
            if constexpr (face[2] == face[3]) return;  // a triangle is flat
            auto edge = [&](int k) { return x.at[face[(k + 1) % 4]] - x.at[face[k]]; };
            V3<Lanes> p = edge(0), q = edge(1), r = edge(2), s = edge(3);
            V3<Lanes> n0 = cross(s, p), n1 = cross(p, q), n2 = cross(q, r), n3 = cross(r, s);
            low = min(cosine(n0, n2), min(cosine(n1, n3), low));
        });
        low = max(low, broadcast<Lanes>(-1.0));
        store(1.0 - low * low * low, first, count, worst);
    });
}

void volume(Points points, Hexes hexes, std::span<double> enclosed) {
    expect(enclosed.size() == hexes.size(), "enclosed: one for each of hexes is expected");
    for_each_block<Lanes>(hexes, [&](auto cell, std::int64_t first, int count) {
        using Cell = decltype(cell);
        auto x = from_first_corner(gather_corners<Lanes>(points, hexes, first, count));
        Lanes sum{};
        unroll<Cell::table.faces>([&](auto f) {
            constexpr auto &face = Cell::table.face_nodes[f];
            auto &a = x.at[face[0]], &b = x.at[face[1]], &c = x.at[face[2]], &d = x.at[face[3]];
            sum += dot(a + b + c + d, cross(c - a, d - b));
        });
        store(sum * (1.0 / 24), first, count, enclosed);
    });
}

}  // namespace hexmend
