// What local methods do at one node: Algorithms A.2 to A.5 on its patch.
#pragma once

#include <atomic>

#include "energy/node_patch.hpp"
#include "smoothers/line_search.hpp"
#include "smoothers/local.hpp"

namespace hexmend {

struct SearchDirection {
    V3<double> d;
    double slope, shift;
    bool fallback;
};

// Algorithm A.2: p_k = -grad of the p-th root of f, the objective (3.3) of the patch.
inline V3<double> steepest_descent(double f, const V3<double> &gradient, double p) {
    double factor = p == 2 ? -0.5 / std::sqrt(f) : -std::pow(f, 1 / p - 1) / p;  // (C.2)
    return factor * gradient;
}

// Algorithm A.4: what is added to the eigenvalues, so that the least is at least a thousandth of the greatest.
inline double eigenvalue_shift(const SymmetricMatrix &hessian) {
    auto [smallest, largest] = extreme_eigenvalues(hessian);
    return smallest < 0.001 * largest ? 0.001 * largest - smallest : 0.0;
}

// Algorithms A.3 and A.4: H p_k = -grad f, in A.4 after the eigenvalues were raised.
inline V3<double> newton_direction(SymmetricMatrix hessian, const V3<double> &gradient, double shift) {
    if (shift > 0) hessian.add_to_diagonal(shift);
    return solve(hessian, -gradient);
}

template <class T>
inline SearchDirection search_direction(const NodePatch<T> &patch, const ValueAndGradient &at, const LocalStep &how) {
    SearchDirection chosen{};
    if (how.direction != STEEPEST_DESCENT) {
        SymmetricMatrix hessian = patch.hessian();
        if (how.direction == MODIFIED_NEWTON) chosen.shift = eigenvalue_shift(hessian);
        chosen.d = newton_direction(hessian, at.gradient, chosen.shift);
    }
    chosen.slope = dot(at.gradient, chosen.d);
    if (!(chosen.slope < 0)) {  // no direction of descent
        chosen.fallback = how.direction != STEEPEST_DESCENT;
        chosen.d = steepest_descent(at.value, at.gradient, how.power.p);
        chosen.slope = dot(at.gradient, chosen.d);
    }
    return chosen;
}

// Algorithm A.5 along d: the accepted step; 0 if none of `cuts` + 1 trials descends enough, or none can any more.
// `hear` is told of each trial.
template <bool soft, class T, class Observer>
inline double backtracking_line_search(NodePatch<T> &patch, const ValueAndGradient &at, const SearchDirection &chosen,
                                       const LocalStep &how, Observer &observer) {
    patch.set_direction(chosen.d);
    double alpha = how.first;
    for (int cut = 0; cut <= how.cuts; ++cut, alpha *= how.shrink) {
        double trial = patch.template value_along<soft>(alpha, how.delta, how.power);
        double bound = at.value + how.c1 * alpha * chosen.slope;
        observer.on_trial(patch.size(), alpha, trial, bound);
        if (trial < bound) return alpha;
        if (lost_in_rounding(alpha, chosen.slope, at.value)) return 0;
    }
    return 0;
}

// The node that a star belongs to.
inline std::int32_t node_of(Hexes hexes, Star star) { return hexes[star[0] / 8][star[0] % 8]; }

// Visit nodes that share no hex, stage by stage: while one waits for its roots and quotients the processor works on
// another. `hear` is told what becomes of each: its trials, and what was chosen, taken and reached at the end.
template <bool soft, class T, int nodes, class Observer>
inline void visit(NodePatch<T> (&patch)[nodes], Points points, Hexes hexes, const Star (&star)[nodes],
                  const LocalStep &how, Observer &&observer) {
    double scale[nodes];
    ValueAndGradient at[nodes];
    for (int k = 0; k < nodes; ++k) scale[k] = patch[k].load(points, hexes, star[k]);
    for (int k = 0; k < nodes; ++k) patch[k].template tabulate<soft>(how.delta);  // meant for edges of mean length 1
    for (int k = 0; k < nodes; ++k) at[k] = patch[k].template value_and_gradient<soft>(how.delta, how.power);
    for (int k = 0; k < nodes; ++k) {
        const V3<double> &g = at[k].gradient;
        if (scale[k] == 0 || at[k].value == 0 || (g.x == 0 && g.y == 0 && g.z == 0)) {
            observer.on_rejected(FLAT);
            continue;
        }
        if (!(at[k].value < INF)) {
            observer.on_rejected(INFINITE);
            continue;
        }
        SearchDirection chosen = search_direction(patch[k], at[k], how);
        double alpha = backtracking_line_search<soft>(patch[k], at[k], chosen, how, observer);
        if (alpha == 0) {
            observer.on_rejected(NO_DESCENT, chosen);
            continue;
        }
        std::int32_t node = node_of(hexes, star[k]);
        const Point &from = points[node];
        const V3<double> &d = chosen.d;
        observer.on_moved(
            node,
            {from[0] + alpha * d.x / scale[k], from[1] + alpha * d.y / scale[k], from[2] + alpha * d.z / scale[k]},
            chosen, alpha);
    }
}

// Moves the nodes that are visited, and counts how often trial steps ask a hex for its energy.
struct NodeMover {
    std::span<Point> points;
    std::int64_t evaluations = 0;

    void on_trial(int hexes, double, double, double) { evaluations += hexes; }
    void on_rejected(StepStatus, const SearchDirection & = {}) {}
    void on_moved(std::int32_t node, const Point &place, const SearchDirection &, double) { points[node] = place; }
};

// The most hexes that meet at one of `nodes`.
inline std::int64_t largest_star(Indices start, Indices nodes) {
    std::int32_t most = 0;
    for (auto i : nodes) most = std::max(most, start[i + 1] - start[i]);
    return most;
}

// Nodes that one thread takes at a time.
constexpr std::int64_t NODES_PER_CHUNK = 64;

// Nodes that are visited together.
constexpr int INTERLEAVED = 2;

// Returns how often trial steps asked a hex for its energy.
template <bool soft, class T>
std::int64_t sweep_of(std::span<Point> points, Hexes hexes, Indices start, Indices corners, Indices groups,
                      Indices nodes, const LocalStep &how) {
    std::int64_t most = largest_star(start, nodes);
    std::atomic<std::int64_t> evaluations = 0;
    for (std::size_t g = 0; g + 1 < groups.size(); ++g) {
        auto group = nodes.subspan(groups[g], groups[g + 1] - groups[g]);
        parallel_chunks(group.size(), NODES_PER_CHUNK, [&](std::int64_t begin, std::int64_t end) {
            NodePatch<T> alone[1]{NodePatch<T>(most)}, several[INTERLEAVED]{NodePatch<T>(most), NodePatch<T>(most)};
            auto star = [&](std::int64_t k) {
                return corners.subspan(start[group[k]], start[group[k] + 1] - start[group[k]]);
            };
            NodeMover mover{points};
            std::int64_t k = begin;
            if constexpr (width<T> > 1)
                for (; k + INTERLEAVED <= end; k += INTERLEAVED)
                    visit<soft>(several, points, hexes, {star(k), star(k + 1)}, how, mover);
            for (; k < end; ++k) visit<soft>(alone, points, hexes, {star(k)}, how, mover);
            evaluations += mover.evaluations;
        });
    }
    return evaluations;
}

}  // namespace hexmend
