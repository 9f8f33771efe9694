#include "boundary/closest_point_cache.hpp"

#include <atomic>

#include "boundary/four_pieces.hpp"
#include "simd/threads.hpp"

namespace hexmend {
namespace {

// A proof leaves this share of a distance to rounding errors.
constexpr double ROUNDING = 1e-9;
// New pieces are looked for within the distance of the farthest of the old ones, times the root of this.
constexpr double MARGIN = 1.5;
// Failures from which on pieces are found at one query in sixteen.
constexpr int MOST_FAILURES = 5;
constexpr std::int64_t POINTS_PER_CHUNK = 256;

struct NumberedSquare {
    double square;
    std::int32_t piece;
};

// The pieces nearest to a point that are nearer than the bound, a squared distance; in ascending order, up to `most`.
template <int most> struct NearestPieces {
    double bound;
    NumberedSquare at[most];
    int count = 0;

    double limit() const { return count == most ? at[most - 1].square : bound; }

    void put(double square, std::int32_t piece) {
        if (!(square < limit())) return;
        int place = count < most ? count++ : most - 1;
        for (; place > 0 && at[place - 1].square > square; --place) at[place] = at[place - 1];
        at[place] = {square, piece};
    }
};

}  // namespace

ClosestPointCache::ClosestPointCache(const BoxTrees &trees, Indices roots)
    : trees_(trees), slots_(roots.size()), fours_(new FourPieces[FOURS * roots.size()]) {
    expect_roots(roots, trees.links.size());
    for (std::size_t s = 0; s < roots.size(); ++s) slots_[s] = {{}, {}, roots[s], -1, 0, false, false, 0, 0};
}

ClosestPointCache::~ClosestPointCache() = default;

ClosestPoint ClosestPointCache::closest(std::int32_t number, const Point &x) const {
    Slot &slot = slots_[number];
    std::atomic_ref<std::int32_t> is_in_use(slot.is_in_use);
    if (is_in_use.exchange(1, std::memory_order_acquire)) return trees_.closest(x, slot.root);
    FourPieces *fours = &fours_[std::size_t{FOURS} * number];
    ClosestPoint best;
    double farthest = INF;
    if (is_finite(x) && !is_proved(slot, fours, x, best, farthest))
        best = closest_of_tree(slot, fours, x, best.piece, farthest);
    is_in_use.store(0, std::memory_order_release);
    return best;
}

// Find the closest point among the pieces that are kept; return whether it is the closest one of the whole tree. If
// not, write the squared distance of the farthest of these pieces.
bool ClosestPointCache::is_proved(Slot &slot, const FourPieces *fours, const Point &x, ClosestPoint &best,
                                  double &farthest) {
    if (!slot.has_pieces) return false;
    Four squares{};
    const double moved = length(vector(x) - vector(slot.centre));
    const V3<Four> at = broadcast_point(x);
    for (int n = 0; n < FOURS; ++n) {
        squares = max(squares, improve(best, fours[n], at));
        if (std::sqrt(best.square) + moved < slot.radius[n]) {
            slot.has_served = true;
            return true;
        }
    }
    farthest = std::max({squares[0], squares[1], squares[2], squares[3]});
    return false;
}

// Return whether the pieces near to a point are to be found, now that it needs a search. At its first query it may be
// far from where it is later. Where it moves so far that its pieces serve no query, they are found ever more rarely.
bool ClosestPointCache::wants_pieces(Slot &slot) {
    if (slot.has_pieces) {
        slot.failures = slot.has_served ? 0 : std::min(slot.failures + 1, MOST_FAILURES);
        slot.wait = (1 << std::max(slot.failures - 1, 0)) - 1;
        slot.has_pieces = slot.has_served = false;
    }
    if (slot.last < 0) return false;
    if (slot.wait == 0) return true;
    --slot.wait;
    return false;
}

// Search the tree, and keep the nearest pieces for the next queries. `known` is a piece that is near, -1 for none; as
// many pieces as are kept are within the squared distance `farthest`.
ClosestPoint ClosestPointCache::closest_of_tree(Slot &slot, FourPieces *fours, const Point &x, std::int32_t known,
                                                double farthest) const {
    if (!wants_pieces(slot)) {
        ClosestPoint best = trees_.closest(x, slot.root, 0, known < 0 ? slot.last : known);
        slot.last = best.piece;
        return best;
    }
    ClosestPoint best;
    NearestPieces<CHILDREN * FOURS + 1> nearest{MARGIN * farthest, {}};
    const V3<Four> at = broadcast_point(x);
    visit_leaves(trees_, slot.root, at, nearest.bound, [&](std::int32_t first, std::int32_t count) {
        Four squares = improve(best, gather_leaf(trees_, first, count), at);
        for (int i = 0; i < count; ++i) nearest.put(squares[i], first + i);
        return nearest.limit();
    });
    slot.centre = x, slot.last = best.piece, slot.has_pieces = nearest.count > 0;
    for (int n = 0; n < FOURS && slot.has_pieces; ++n) {
        const int begin = CHILDREN * n, end = begin + CHILDREN;
        fours[n] = gather(trees_.points, trees_.pieces,
                          [&](int i) { return nearest.at[std::min(begin + i, nearest.count - 1)].piece; });
        slot.radius[n] = (1 - ROUNDING) * std::sqrt(end < nearest.count ? nearest.at[end].square : nearest.bound);
    }
    return best;
}

void closest_of_slots(const ClosestPointCache &cache, Indices slots, Points x, std::span<std::int32_t> piece,
                      std::span<Point> places, std::span<Barycentric> weights) {
    expect(have_rows(x.size(), slots, piece, places, weights),
           "slots, x, piece, places and weights have different lengths: expected a row a point");
    for (std::int32_t slot : slots)
        expect(slot >= 0 && slot < static_cast<std::int64_t>(cache.size()), "slots: a number is out of range");
    parallel_for(x.size(), POINTS_PER_CHUNK, [&](std::int64_t i) {
        ClosestPoint found = cache.closest(slots[i], x[i]);
        piece[i] = found.piece, places[i] = found.place, weights[i] = found.weights;
    });
}

}  // namespace hexmend
