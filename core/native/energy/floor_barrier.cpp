#include "energy/floor_barrier.hpp"

#include <memory>
#include <vector>

#include "energy/block_scatter.hpp"
#include "energy/hex_hessian.hpp"

namespace hexmend {
namespace {

bool any(const Bits &marks) {
#if defined(__AVX512F__)
    return _mm512_test_epi64_mask(bit_cast<__m512i>(marks), bit_cast<__m512i>(marks)) != 0;
#else
    for (int i = 0; i < LANES; ++i)
        if (marks[i]) return true;
    return false;
#endif
}

// Lanes that count whose y is below `limit`, or no number.
inline Bits below(const Lanes &value, const Lanes &floor, double band, const Bits &counted, double limit) {
    return counted & ~((value - floor) / band >= limit);
}

// b(y) with its derivatives by the quantity that y is of, at weight 1.
struct Barriers {
    Lanes value{}, first{}, second{};
    bool any = false;  // some lane is below its band
};

// Of a value with its floor.
template <bool derivatives>
Barriers barrier_of(const Lanes &value, const Lanes &floor, double band, const Bits &counted) {
    Barriers b;
    if (!any(below(value, floor, band, counted, 1))) return b;
    Lanes y = (value - floor) / band;
    double slope = 1 / band;
    for (int i = 0; i < LANES; ++i) {
        if (!counted[i] || y[i] >= 1) continue;
        b.any = true;
        double z = y[i];
        if (!(z > 0)) {
            b.value[i] = INF;
            continue;
        }
        if constexpr (derivatives) {
            b.first[i] = slope * (2 - z - 1 / z);
            b.second[i] = slope * slope * (1 / (z * z) - 1);
        } else {
            b.value[i] = -std::log(z) + (z - 1) * (1 - 0.5 * (z - 1));
        }
    }
    return b;
}

// Scaled Jacobian s of a corner tetrahedron with its derivatives: g is that by the edges, a has the edges over their
// squares.
struct CornerJacobian {
    Lanes s, over_lengths;
    V3<Lanes> inverse_squares;
    M3<Lanes> a, g;
};

template <class Cell> inline CornerJacobian corner_jacobian(const M3<Lanes> &edges, const Lanes &s) {
    auto c = cofactors(edges);
    auto over_square = [](const V3<Lanes> &e) { return square(e) > 0.0 ? 1.0 / square(e) : Lanes{}; };
    V3<Lanes> inverse{over_square(edges.u), over_square(edges.v), over_square(edges.w)};
    Lanes over = sqrt(inverse.x * inverse.y * inverse.z);
    if constexpr (!Cell::is_cube) over = Cell::inverse_determinant * over;
    M3<Lanes> a{inverse.x * edges.u, inverse.y * edges.v, inverse.z * edges.w};
    M3<Lanes> g{over * c.u - s * a.u, over * c.v - s * a.v, over * c.w - s * a.w};
    return {s, over, inverse, a, g};
}

// Add first * s'' + second * s' s'^T of corner t.
//
// With b the columns of S over their squares, g = s' and L = 1/(|u| |v| |w|), the block of two edges i, j of s'' is
// L [d cof_i/d e_j] - g_i a_j' - a_i g_j' - s a_i a_j', and for i = j also s (2 a_i a_i' - I/|e_i|^2).
template <class Cell, int t>
__attribute__((noinline)) void add_corner_hessian(const M3<Lanes> &edges, const CornerJacobian &at, const Barriers &by,
                                                  HessianSums &sums) {
    constexpr auto &n = Cell::table.corner_tetrahedra[t];
    const auto &[u, v, w] = edges;
    const auto &[gu, gv, gw] = at.g;
    const auto &[au, av, aw] = at.a;
    Lanes half = 0.5 * by.second, none{};
    V3<Lanes> zero{};
    auto mixed = [&](const V3<Lanes> &g, const V3<Lanes> &a) { return half * g - by.first * a; };
    V3<Lanes> pu = mixed(gu, au), pv = mixed(gv, av), pw = mixed(gw, aw);
    V3<Lanes> g0 = -(gu + gv + gw), a0 = -(au + av + aw), p0 = -(pu + pv + pw);
    Lanes twist = -by.first * at.over_lengths, own = -by.first * at.s;
    V3<Lanes> eu = twist * u, ev = twist * v, ew = twist * w;
    auto twice = [&](const V3<Lanes> &a) -> V3<Lanes> { return own * (a0 + a + a); };
    sums.pair<n[0], n[1]>(g0, p0, gu, pu, -own * at.inverse_squares.x, ew - ev);
    sums.pair<n[0], n[2]>(g0, p0, gv, pv, -own * at.inverse_squares.y, eu - ew);
    sums.pair<n[0], n[3]>(g0, p0, gw, pw, -own * at.inverse_squares.z, ev - eu);
    sums.pair<n[1], n[2]>(gu, pu, gv, pv, none, ew);
    sums.pair<n[1], n[3]>(gu, pu, gw, pw, none, -ev);
    sums.pair<n[2], n[3]>(gv, pv, gw, pw, none, eu);
    sums.pair<n[0], n[1]>(twice(au), zero, zero, au, none, zero);
    sums.pair<n[0], n[2]>(twice(av), zero, zero, av, none, zero);
    sums.pair<n[0], n[3]>(twice(aw), zero, zero, aw, none, zero);
    sums.pair<n[1], n[2]>(own * au, zero, zero, av, none, zero);
    sums.pair<n[1], n[3]>(own * au, zero, zero, aw, none, zero);
    sums.pair<n[2], n[3]>(own * av, zero, zero, aw, none, zero);
}

// Floors of the hexes in the lanes of a block.
struct LaneFloors {
    Lanes jacobian = broadcast<Lanes>(-INF), quality = broadcast<Lanes>(-INF);
    Bits ignored{};

    template <class Row> LaneFloors(const Floors &floors, int count, const Row &row) {
        for (int i = 0; i < count; ++i) {
            auto hex = row(i);
            jacobian[i] = floors.jacobians[hex], quality[i] = floors.qualities[hex], ignored[i] = floors.ignored[hex];
        }
    }

    bool any() const { return some(jacobian) || some(quality); }

    // Some lane has a floor of this kind.
    static bool some(const Lanes &floor) { return hexmend::any(floor > -INF); }

    Bits counted(int t) const { return (ignored & (std::int64_t{1} << t)) == 0; }
};

// Value that is above any floor.
inline Lanes above_all() { return broadcast<Lanes>(INF); }

template <class Cell, class Scales>
Lanes quality_of(const Corners<Lanes> &x, const Scales &scales, const auto &counted) {
    Lanes sum{};
    unroll<Cell::corners>([&](auto t) {
        sum += 1.0 / eta<false>(x.shape<Cell, t>(), scales.template columns<Cell, t>(), 0.0, counted(t));
    });
    return sum * Cell::share;
}

constexpr Bits ALL = Bits{} - 1;

// A derivative by the sum of eighths of the corners' q(T) from that by their mean.
template <class Cell> Lanes by_eighths(const Lanes &derivative) {
    if constexpr (Cell::is_cube) return derivative;
    return Cell::share_of_eighths * derivative;
}

template <class Target>
void values_of(Points points, Hexes hexes, const Floors &floors, OmittedCorners omitted, std::span<double> values,
               const Target &target) {
    for_each_block<Lanes>(hexes, [&](auto cell, std::int64_t first, int count) {
        using Cell = decltype(cell);
        LaneFloors block(floors, count, [&](int i) { return first + i; });
        Lanes sum{};
        if (block.any()) {
            auto x = gather_corners<Lanes>(points, hexes, first, count);
            if (block.some(block.jacobian))
                unroll<Cell::corners>([&](auto t) {
                    auto s = scaled_jacobian<Cell>(x.edges<Cell, t>());
                    sum += barrier_of<false>(s, block.jacobian, floors.jacobian_band, block.counted(t)).value;
                });
            if (block.some(block.quality)) {
                CornerMask<Lanes> counted(omitted, first, count);
                auto quality = quality_of<Cell>(x, scales_of<Lanes>(target, first, count), counted);
                sum += barrier_of<false>(quality, block.quality, floors.quality_band, ALL).value;
            }
        }
        store(floors.weight * sum, first, count, values);
    });
}

template <class Target>
void gradient_of(Points points, Hexes hexes, const Floors &floors, OmittedCorners omitted, CornerVectors shares,
                 const Target &target) {
    for_each_block<Lanes>(hexes, [&](auto cell, std::int64_t first, int count) {
        using Cell = decltype(cell);
        LaneFloors block(floors, count, [&](int i) { return first + i; });
        if (!block.any()) return;
        auto x = gather_corners<Lanes>(points, hexes, first, count);
        auto scales = scales_of<Lanes>(target, first, count);
        CornerMask<Lanes> counted(omitted, first, count);
        Corners<Lanes> total;
        bool some = false;
        auto quality = block.some(block.quality) ? quality_of<Cell>(x, scales, counted) : above_all();
        auto by = barrier_of<true>(quality, block.quality, floors.quality_band, ALL);
        if (by.any) {
            some = true;
            unroll<Cell::corners>([&](auto t) {
                auto edges = x.shape<Cell, t>();
                auto columns = scales.template columns<Cell, t>();
                const auto &s = scale(edges, columns);
                auto cof = cofactors(s);
                auto d = Inverse{}(derivatives<false>(edges, columns, s, cof, 0.0, counted(t)));
                total.scatter<Cell, t>(by_edges<Cell>(scale(gradient<Lanes>(d, s, cof), columns)));
            });
            for (auto &corner : total.at) corner = by_eighths<Cell>(by.first) * corner;
        }
        unroll<Cell::corners>([&](auto t) {
            auto edges = x.edges<Cell, t>();
            auto s = scaled_jacobian<Cell>(edges);
            auto here = barrier_of<true>(s, block.jacobian, floors.jacobian_band, block.counted(t));
            if (!here.any) return;
            some = true;
            auto g = corner_jacobian<Cell>(edges, s).g;
            total.template scatter<Cell, t>(M3<Lanes>{here.first * g.u, here.first * g.v, here.first * g.w});
        });
        if (!some) return;
        for (auto &corner : total.at) corner = broadcast<Lanes>(floors.weight) * corner;
        std::array<double, 24> rows[LANES];
        store(total, 0, LANES, std::span<std::array<double, 24>>(rows));
        for (int i = 0; i < count; ++i)
            for (int k = 0; k < 24; ++k) shares[first + i][k] += rows[i][k];
    });
}

// Values of y from which on nothing takes part, whatever the rounding of y.
constexpr double SURELY_ABOVE = 1 + 1e-9;

// The hexes of a share that may take part, in its order: most are far above their floors.
template <class Target>
std::vector<std::int32_t> hexes_near_floors(Points points, const Floors &floors, OmittedCorners omitted,
                                            const HexShares &shared, std::int64_t share, const Target &target) {
    std::vector<std::int32_t> near;
    int count = 0;
    for (auto first = shared.start[share]; first < shared.start[share + 1]; first += count) {
        count = shared.alike(first, shared.start[share + 1]);
        const std::int32_t *numbers = &shared.numbers[first];
        LaneFloors block(floors, count, [&](int i) { return numbers[i]; });
        if (!block.any()) continue;
        Hex hexes[LANES];
        for (int i = 0; i < count; ++i) hexes[i] = shared.hexes[numbers[i]];
        auto x = gather_corners<Lanes>(points, hexes, 0, count);
        Bits found{};
        with_kind(hexes[0], [&](auto cell) {
            using Cell = decltype(cell);
            unroll<Cell::corners>([&](auto t) {
                auto s = scaled_jacobian<Cell>(x.edges<Cell, t>());
                found |= below(s, block.jacobian, floors.jacobian_band, block.counted(t), SURELY_ABOVE);
            });
            if (!block.some(block.quality)) return;
            auto scales = scales_of<Lanes>(target, [&](int i) { return shared.number(first, i, count); });
            std::uint8_t bits[LANES] = {};
            for (int i = 0; i < count; ++i) bits[i] = omitted[numbers[i]];
            auto quality = quality_of<Cell>(x, scales, CornerMask<Lanes>(bits, 0, count));
            found |= below(quality, block.quality, floors.quality_band, ALL, SURELY_ABOVE);
        });
        for (int i = 0; i < count; ++i)
            if (found[i]) near.push_back(numbers[i]);
    }
    return near;
}

template <class Real, class Target>
void assemble_of(Points points, const Floors &floors, OmittedCorners omitted, const HexShares &shared,
                 std::span<std::array<Real, 9>> off_diagonal, std::span<std::array<Real, 6>> diagonal,
                 const Target &target) {
    parallel(static_cast<std::int64_t>(shared.bounds.size()) - 1, [&](std::int64_t share) {
        auto low = shared.bounds[share], high = shared.bounds[share + 1];
        auto sums = std::make_unique<HessianSums>();
        auto values = std::make_unique<Real[][HEX_STRIDE]>(LANES);
        const auto near = hexes_near_floors(points, floors, omitted, shared, share, target);
        int count = 0;
        for (std::size_t first = 0; first < near.size(); first += count) {
            const std::int32_t *numbers = &near[first];
            count = alike(std::min<std::int64_t>(LANES, near.size() - first),
                          [&](int i) -> const Hex & { return shared.hexes[numbers[i]]; });
            LaneFloors block(floors, count, [&](int i) { return numbers[i]; });
            Hex hexes[LANES];
            for (int i = 0; i < count; ++i) hexes[i] = shared.hexes[numbers[i]];
            auto x = gather_corners<Lanes>(points, hexes, 0, count);
            auto scales = scales_of<Lanes>(target, [&](int i) { return numbers[std::min(i, count - 1)]; });
            std::uint8_t bits[LANES] = {};
            for (int i = 0; i < count; ++i) bits[i] = omitted[numbers[i]];
            CornerMask<Lanes> counted(bits, 0, count);
            *sums = HessianSums{};
            bool some = false;
            with_kind(hexes[0], [&](auto cell) {
                using Cell = decltype(cell);
                auto quality = block.some(block.quality) ? quality_of<Cell>(x, scales, counted) : above_all();
                auto by = barrier_of<true>(quality, block.quality, floors.quality_band, ALL);
                some = by.any;
                if (by.any) {
                    unroll<Cell::corners>(
                        [&](auto t) { add_tetrahedron<Cell, false, t>(x, scales, 0.0, counted(t), *sums, Inverse{}); });
                    for (auto &entry : sums->at) entry = by_eighths<Cell>(by.first) * entry;
                }
                unroll<Cell::corners>([&](auto t) {
                    auto edges = x.edges<Cell, t>();
                    auto s = scaled_jacobian<Cell>(edges);
                    auto here = barrier_of<true>(s, block.jacobian, floors.jacobian_band, block.counted(t));
                    if (!here.any) return;
                    some = true;
                    add_corner_hessian<Cell, t>(edges, corner_jacobian<Cell>(edges, s), here, *sums);
                });
                if (!some) return;
                auto second = by_eighths<Cell>(by_eighths<Cell>(by.second));
                weigh_hessian<Real>(*sums, broadcast<Lanes>(floors.weight), floors.weight * second, values.get());
            });
            if (!some) continue;
            for (int i = 0; i < count; ++i) {
                Hex slots = shared.slots_of(numbers[i]);
                scatter<Real>(values[i], slots, blocks_of(slots, shared.row_start, shared.columns), low, high,
                              off_diagonal, diagonal);
            }
        }
    });
}

void expect_floors(const Floors &floors, std::size_t hexes, const TargetMatrices *target) {
    expect(floors.jacobians.size() == hexes, "floors: one for each hex is expected");
    expect_rows(target, hexes);
}

}  // namespace

void floor_qualities(Points points, Hexes hexes, OmittedCorners omitted, std::span<double> values,
                     const TargetMatrices *target) {
    expect(have_rows(hexes.size(), omitted, values), "omitted and values: one for each hex is expected");
    expect_rows(target, hexes.size());
    with_target(target, [&](const auto &w) {
        for_each_block<Lanes>(hexes, [&](auto cell, std::int64_t first, int count) {
            using Cell = decltype(cell);
            auto x = gather_corners<Lanes>(points, hexes, first, count);
            CornerMask<Lanes> counted(omitted, first, count);
            store(quality_of<Cell>(x, scales_of<Lanes>(w, first, count), counted), first, count, values);
        });
    });
}

void floor_values(Points points, Hexes hexes, const Floors &floors, OmittedCorners omitted, std::span<double> values,
                  const TargetMatrices *target) {
    expect(have_rows(hexes.size(), omitted, values), "omitted and values: one for each hex is expected");
    expect_floors(floors, hexes.size(), target);
    with_target(target, [&](const auto &w) { values_of(points, hexes, floors, omitted, values, w); });
}

void add_floor_gradient(Points points, Hexes hexes, const Floors &floors, OmittedCorners omitted, CornerVectors shares,
                        const TargetMatrices *target) {
    expect(have_rows(hexes.size(), omitted, shares), "omitted and shares: one for each hex is expected");
    expect_floors(floors, hexes.size(), target);
    with_target(target, [&](const auto &w) { gradient_of(points, hexes, floors, omitted, shares, w); });
}

template <class Real>
void assemble_floors(Points points, const Floors &floors, OmittedCorners omitted, const HexShares &shared,
                     std::span<std::array<Real, 9>> off_diagonal, std::span<std::array<Real, 6>> diagonal,
                     const TargetMatrices *matrices) {
    shared.expect_sizes(points.size(), omitted.size(), off_diagonal.size(), diagonal.size());
    expect_floors(floors, omitted.size(), matrices);
    with_target(matrices,
                [&](const auto &w) { assemble_of<Real>(points, floors, omitted, shared, off_diagonal, diagonal, w); });
}

#define FOR_REAL(Real)                                                                                  \
    template void assemble_floors<Real>(Points, const Floors &, OmittedCorners, const HexShares &,      \
                                        std::span<std::array<Real, 9>>, std::span<std::array<Real, 6>>, \
                                        const TargetMatrices *);
FOR_REAL(float)
FOR_REAL(double)

}  // namespace hexmend
