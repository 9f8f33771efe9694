// What local methods do at one node: Algorithms A.2 to A.5 on its patch.
#pragma once

#include "local.hpp"
#include "patch.hpp"

namespace hexmend {

struct Chosen {
    V3<double> d;
    double slope;
    bool fallback;
};

// Algorithm A.2: p_k = -grad of the p-th root of f, the objective (3.3) of the patch.
inline V3<double> steepest_descent(double f, const V3<double> &gradient, double p) {
    double factor = p == 2 ? -0.5 / std::sqrt(f) : -std::pow(f, 1 / p - 1) / p;  // (C.2)
    return factor * gradient;
}

// Algorithms A.3 and A.4: H p_k = -grad f, in A.4 after the least eigenvalue was raised.
inline V3<double> newton(Symmetric hessian, const V3<double> &gradient, bool modified) {
    if (modified) {
        auto [least, greatest] = extreme_eigenvalues(hessian);
        if (least < 0.001 * greatest) hessian.raise(0.001 * greatest - least);
    }
    return solve(hessian, -gradient);
}

template <class T> inline Chosen choose(const Patch<T> &patch, const Visit &at, const LocalStep &how) {
    Chosen chosen{};
    if (how.direction != STEEPEST_DESCENT)
        chosen.d = newton(patch.hessian(), at.gradient, how.direction == MODIFIED_NEWTON);
    chosen.slope = dot(at.gradient, chosen.d);
    if (!(chosen.slope < 0)) {  // no direction of descent
        chosen.fallback = how.direction != STEEPEST_DESCENT;
        chosen.d = steepest_descent(at.value, at.gradient, how.p);
        chosen.slope = dot(at.gradient, chosen.d);
    }
    return chosen;
}

// Algorithm A.5 along d: the accepted step; 0 if none of `cuts` + 1 trials descends enough. `tell(alpha, value)` hears
// of each trial.
template <bool soft, class T, class Tell>
inline double back_line_search(Patch<T> &patch, const Visit &at, const Chosen &chosen, const LocalStep &how,
                               Tell &&tell) {
    patch.aim(chosen.d);
    double alpha = how.first;
    for (int cut = 0; cut <= how.cuts; ++cut, alpha *= how.shrink) {
        double trial = patch.template value_along<soft>(alpha, how.delta, how.p);
        tell(alpha, trial);
        if (trial < at.value + how.c1 * alpha * chosen.slope) return alpha;
    }
    return 0;
}

// Several nodes that share no hex, moved as a method moves them, stage by stage: while one waits for its roots and
// quotients the processor works on another.
template <bool soft, class T, int nodes>
inline void visit(Patch<T> (&patch)[nodes], std::span<Point> points, Hexes hexes, const Star (&star)[nodes],
                  const LocalStep &how) {
    double scale[nodes];
    Visit at[nodes];
    for (int k = 0; k < nodes; ++k) scale[k] = patch[k].load(points, hexes, star[k]);
    for (int k = 0; k < nodes; ++k) patch[k].template tabulate<soft>(how.delta);  // meant for edges of mean length 1
    for (int k = 0; k < nodes; ++k) at[k] = patch[k].template value_and_gradient<soft>(how.delta, how.p);
    for (int k = 0; k < nodes; ++k) {
        const V3<double> &g = at[k].gradient;
        if (scale[k] == 0 || !(0 < at[k].value && at[k].value < INF) || (g.x == 0 && g.y == 0 && g.z == 0)) continue;
        Chosen chosen = choose(patch[k], at[k], how);
        double alpha = back_line_search<soft>(patch[k], at[k], chosen, how, [](double, double) {});
        if (alpha == 0) continue;
        Point &node = points[hexes[star[k][0] / 8][star[k][0] % 8]];
        node[0] += alpha * chosen.d.x / scale[k];
        node[1] += alpha * chosen.d.y / scale[k];
        node[2] += alpha * chosen.d.z / scale[k];
    }
}

// The most hexes that meet at one of `nodes`.
inline std::int64_t most_at(Indices start, Indices nodes) {
    std::int32_t most = 0;
    for (auto i : nodes) most = std::max(most, start[i + 1] - start[i]);
    return most;
}

// Nodes that one thread takes at a time.
constexpr std::int64_t NODES = 64;

// Nodes that are visited together.
constexpr int TOGETHER = 2;

template <bool soft, class T>
void sweep_of(std::span<Point> points, Hexes hexes, Indices start, Indices corners, Indices groups, Indices nodes,
              const LocalStep &how) {
    std::int64_t most = most_at(start, nodes);
    for (std::size_t g = 0; g + 1 < groups.size(); ++g) {
        auto group = nodes.subspan(groups[g], groups[g + 1] - groups[g]);
        parallel_chunks(group.size(), NODES, [&](std::int64_t begin, std::int64_t end) {
            Patch<T> alone[1]{Patch<T>(most)}, several[TOGETHER]{Patch<T>(most), Patch<T>(most)};
            auto star = [&](std::int64_t k) {
                return corners.subspan(start[group[k]], start[group[k] + 1] - start[group[k]]);
            };
            std::int64_t k = begin;
            if constexpr (width<T> > 1)
                for (; k + TOGETHER <= end; k += TOGETHER)
                    visit<soft>(several, points, hexes, {star(k), star(k + 1)}, how);
            for (; k < end; ++k) visit<soft>(alone, points, hexes, {star(k)}, how);
        });
    }
}

}  // namespace hexmend
