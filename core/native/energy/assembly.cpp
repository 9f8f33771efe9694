#include "energy/assembly.hpp"

#include <limits>
#include <memory>

#include "energy/block_scatter.hpp"
#include "energy/hex_hessian.hpp"
#include "energy/open_blocks.hpp"

namespace hexmend {
namespace {

// Lowest slot of some hexes, and the highest before `first_separator`; those of fixed nodes, -1, do not count.
std::pair<std::int32_t, std::int32_t> slot_range(std::span<const Hex> slots, std::int32_t first_separator) {
    std::int32_t lowest = std::numeric_limits<std::int32_t>::max(), highest = -1;
    for (const Hex &hex : slots)
        for (auto slot : hex) {
            if (slot >= 0) lowest = std::min(lowest, slot);
            if (slot < first_separator) highest = std::max(highest, slot);
        }
    return {lowest, highest};
}

// Add the hexes of all shares to the blocks; open(low, high) returns those of the rows from `low` to `high` - 1.
template <bool soft, class Real, class Target, class Open>
void assemble_of(Points points, double delta, ObjectiveNorm norm, OmittedCorners omitted, const HexShares &shared,
                 std::int32_t first_separator, const Open &open, std::span<std::array<Real, 6>> diagonal,
                 const Target &target) {
    parallel(static_cast<std::int64_t>(shared.bounds.size()) - 1, [&](std::int64_t share) {
        auto low = shared.bounds[share], high = shared.bounds[share + 1];
        auto off_diagonal = open(low, high);
        auto sums = std::make_unique<HessianSums>();
        auto values = std::make_unique<Real[][HEX_STRIDE]>(LANES);
        int count = 0;
        for (auto first = shared.start[share]; first < shared.start[share + 1]; first += count) {
            count = shared.alike(first, shared.start[share + 1]);
            // Hexes are in the order of slots, and their nodes in that of the mesh: what the next ones need is
            // prefetched.
            const auto end = shared.start[share + 1];
            for (auto next = first + LANES; next < std::min(first + 2 * LANES, end); ++next)
                for (Node node : shared.hexes[shared.numbers[next]])
                    if (auto slot = shared.slots[node]; slot >= 0)
                        __builtin_prefetch(&shared.columns.data()[shared.row_start[slot]]);
            for (auto next = first + 2 * LANES; next < std::min(first + 3 * LANES, end); ++next)
                for (Node node : shared.hexes[shared.numbers[next]])
                    __builtin_prefetch(&shared.slots[node]), __builtin_prefetch(&points[node]);
            for (auto next = first + 3 * LANES; next < std::min(first + 4 * LANES, end); ++next)
                __builtin_prefetch(&shared.hexes[shared.numbers[next]]);
            Hex hexes[LANES], slots[LANES];
            for (int i = 0; i < count; ++i) {
                hexes[i] = shared.hexes[shared.numbers[first + i]];
                slots[i] = shared.slots_of(shared.numbers[first + i]);
            }
            const auto [lowest, highest] = slot_range({slots, static_cast<std::size_t>(count)}, first_separator);
            off_diagonal.open_rows(lowest, highest);
            auto x = gather_corners<Lanes>(points, hexes, 0, count);
            auto scales = scales_of<Lanes>(target, [&](int i) { return shared.number(first, i, count); });
            std::uint8_t bits[LANES];
            for (int i = 0; i < count; ++i) bits[i] = omitted[shared.numbers[first + i]];
            CornerMask<Lanes> counted(bits, 0, count);
            // The blocks are scattered in memory: prefetch them while the values are computed.
            PairBlocks blocks[LANES];
            for (int i = 0; i < count; ++i) {
                blocks[i] = blocks_of(slots[i], shared.row_start, shared.columns);
                for (auto s : blocks[i])
                    if (s >= 0) off_diagonal.prefetch(s);
            }
            *sums = HessianSums{};
            with_kind(hexes[0], [&](auto cell) {
                using Cell = decltype(cell);
                unroll<Cell::corners>(
                    [&](auto t) { add_tetrahedron<Cell, soft, t>(x, scales, delta, counted(t), *sums); });
                weigh_hessian<Cell, Real>(*sums, norm, values.get());
            });
            for (int i = 0; i < count; ++i)
                scatter<Real>(values[i], slots[i], blocks[i], low, high, off_diagonal, diagonal);
        }
        off_diagonal.close();
    });
}

template <class Real, class Open>
void assemble_into(Points points, double delta, ObjectiveNorm norm, OmittedCorners omitted, const HexShares &shared,
                   std::int32_t first_separator, const Open &open, std::span<std::array<Real, 6>> diagonal,
                   const TargetMatrices *matrices) {
    expect_rows(matrices, omitted.size());
    // A copy that the compiler can keep in registers: the AVX-512 build then rounds the same sums as before.
    const auto [bounds, start, numbers, hexes, slots, row_start, columns] = shared;
    const HexShares local{bounds, start, numbers, hexes, slots, row_start, columns};
    with_cases(matrices, delta, [&](auto soft, const auto &w) {
        assemble_of<soft, Real>(points, delta, norm, omitted, local, first_separator, open, diagonal, w);
    });
}

}  // namespace

template <class Real>
void assemble(Points points, double delta, ObjectiveNorm norm, OmittedCorners omitted, const HexShares &shared,
              std::span<std::array<Real, 9>> off_diagonal, std::span<std::array<Real, 6>> diagonal,
              const TargetMatrices *matrices) {
    shared.expect_sizes(points.size(), omitted.size(), off_diagonal.size(), diagonal.size());
    auto open = [&](std::int32_t, std::int32_t) { return WholeBlocks<Real>{off_diagonal}; };
    assemble_into<Real>(points, delta, norm, omitted, shared, 0, open, diagonal, matrices);
}

void assemble_packed(Points points, double delta, ObjectiveNorm norm, OmittedCorners omitted, const HexShares &shared,
                     std::int32_t first_separator, std::span<PackedBlock> off_diagonal,
                     std::span<std::array<float, 6>> diagonal, const TargetMatrices *matrices) {
    shared.expect_sizes(points.size(), omitted.size(), off_diagonal.size(), diagonal.size());
    auto open = [&](std::int32_t low, std::int32_t high) {
        return OpenBlocks(shared.row_start, low, high, first_separator, off_diagonal);
    };
    assemble_into<float>(points, delta, norm, omitted, shared, first_separator, open, diagonal, matrices);
}

#define FOR_REAL(Real)                                                                             \
    template void assemble<Real>(Points, double, ObjectiveNorm, OmittedCorners, const HexShares &, \
                                 std::span<std::array<Real, 9>>, std::span<std::array<Real, 6>>,   \
                                 const TargetMatrices *);
FOR_REAL(float)
FOR_REAL(double)

}  // namespace hexmend
