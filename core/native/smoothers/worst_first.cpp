#include "smoothers/worst_first.hpp"

#include "mesh/quality.hpp"
#include "smoothers/element_step.hpp"

namespace hexmend {
namespace {

// The hex of smaller key, or of lower number if the keys are equal.
inline std::int32_t winner_of(Numbers key, std::int32_t a, std::int32_t b) {
    return key[a] < key[b] || (key[a] == key[b] && a < b) ? a : b;
}

// Prefetch what is needed soon. The worst hex is anywhere in memory, so that waiting for its neighbourhood would take
// longer than the arithmetic.
template <class... T> inline void prefetch(const T *...it) { (__builtin_prefetch(it), ...); }

// A move that may be undone.
struct Move {
    Node node;
    Point from;
};

// Undo the latest moves until `count` remain.
void undo(std::vector<Move> &moves, std::size_t count, std::span<Point> points) {
    for (; moves.size() > count; moves.pop_back()) points[moves.back().node] = moves.back().from;
}

}  // namespace

IntArray tournament(Numbers key, Indices hexes) {
    const std::size_t k = hexes.size();
    std::vector<std::int32_t> tree(2 * k);
    std::copy(hexes.begin(), hexes.end(), tree.begin() + k);
    for (std::size_t i = k; i-- > 1;) tree[i] = winner_of(key, tree[2 * i], tree[2 * i + 1]);
    return {std::move(tree)};
}

void replay(std::span<std::int32_t> tree, Numbers key, std::int64_t leaf) {
    std::size_t i = tree.size() / 2 + leaf;
    const auto h = tree[i];
    while (i > 1) {
        i /= 2;
        auto winner = winner_of(key, tree[2 * i], tree[2 * i + 1]);
        if (winner == tree[i] && winner != h) break;  // h neither won this match nor wins it now: the rest is unchanged
        tree[i] = winner;
    }
}

std::int64_t worst_first_sweep(std::span<Point> points, const HexMesh &mesh, std::span<const bool> free,
                               Indices candidates, std::span<double> q, std::span<bool> valid,
                               const WorstFirstSettings &settings, const SlidingSurface *surface) {
    expect_points(mesh, points);
    expect(free.size() == points.size(), "free: one for each of points is expected");
    expect(have_rows(mesh.hexes.size(), q, valid), "q and valid: one for each hex is expected");
    expect_nodes(surface, points.size());
    if (candidates.empty()) return 0;  // an empty queue has no first element
    const Hexes hexes = mesh.hexes;
    const std::size_t m = hexes.size();
    std::vector<double> key(q.begin(), q.end());
    for (std::size_t h = 0; h < m; ++h) key[h] -= !valid[h];  // inverted hexes come first
    std::vector<std::int32_t> leaf(m, -1), touched_in(m, -1);
    for (std::size_t i = 0; i < candidates.size(); ++i) leaf[candidates[i]] = i;
    auto queue = tournament(key, candidates).values, least = tournament(q, candidates).values;
    double best = q[least[1]], gain = 0, best_gain = 0;
    bool untangled = false;

    std::vector<std::int32_t> touched;
    std::vector<Quality<double>> after(8 * mesh.largest_star());
    std::vector<Move> moves;  // since the best state
    std::int64_t rejected = 0;

    for (std::size_t step = 0; step < candidates.size(); ++step) {
        const auto h = queue[1];
        auto y = with_kind(hexes[h], [&](auto cell) {
            auto x = gather_corners<double>(points, hexes, h, 1);
            return element_step<decltype(cell)>(x, settings.scaling, settings.relaxation);
        });
        const std::size_t moved_before = moves.size();
        touched.clear();
        for (int c = 0; c < table_of(hexes[h]).nodes; ++c) {
            Node i = hexes[h][c];
            if (!free[i]) continue;
            moves.push_back({i, points[i]});
            Point aim = point(y.at[c]);
            points[i] = surface && surface->slides(i) ? surface->project_unless_flipping(points, i, aim) : aim;
            for (auto corner : mesh.star(i)) {
                auto g = corner / 8;
                if (touched_in[g] == static_cast<std::int32_t>(step)) continue;
                touched_in[g] = step;
                touched.push_back(g);
                prefetch(&hexes[g], &q[g], &key[g], &valid[g], &leaf[g]);
            }
        }
        for (auto g : touched)
            for (Node i : hexes[g]) prefetch(&points[i]);
        bool harm = false;
        for (std::size_t r = 0; r < touched.size() && !harm; ++r) {
            after[r] = cell_quality(points, hexes[touched[r]]);
            harm = valid[touched[r]] && !after[r].valid;
        }
        if (harm) {
            ++rejected;
            undo(moves, moved_before, points);
            key[h] += settings.rejection_penalty;
            replay(queue, key, leaf[h]);
            continue;
        }
        key[h] += settings.penalty;
        for (std::size_t r = 0; r < touched.size(); ++r) {
            const auto g = touched[r];
            double rise = after[r].q - q[g];
            gain += rise;
            key[g] += rise;
            q[g] = after[r].q;
            if (after[r].valid && !valid[g]) {
                valid[g] = untangled = true;
                key[g] += 1;
            }
            replay(queue, key, leaf[g]);
            replay(least, q, leaf[g]);
        }
        double now = q[least[1]];
        if (untangled || now > best || (now == best && gain > best_gain)) {
            best = now, best_gain = gain, untangled = false;
            moves.clear();
        }
    }
    undo(moves, 0, points);
    return rejected;
}

}  // namespace hexmend
