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
inline double back_line_search(const Patch<T> &patch, const Visit &at, const Chosen &chosen, const LocalStep &how,
                               Tell &&tell) {
    double alpha = how.first;
    for (int cut = 0; cut <= how.cuts; ++cut, alpha *= how.shrink) {
        double trial = patch.template value<soft>(alpha * chosen.d, how.delta, how.p);
        tell(alpha, trial);
        if (trial < at.value + how.c1 * alpha * chosen.slope) return alpha;
    }
    return 0;
}

// Move a node as a method moves it.
template <bool soft, class T>
inline void visit(Patch<T> &patch, std::span<Point> points, Hexes hexes, Star star, const LocalStep &how) {
    double scale = patch.load(points, hexes, star);  // delta is meant for edges of mean length 1
    if (scale == 0) return;
    patch.template tabulate<soft>(how.delta);
    Visit at = patch.template value_and_gradient<soft>(how.delta, how.p);
    const V3<double> &g = at.gradient;
    if (!(0 < at.value && at.value < INF) || (g.x == 0 && g.y == 0 && g.z == 0)) return;
    Chosen chosen = choose(patch, at, how);
    double alpha = back_line_search<soft>(patch, at, chosen, how, [](double, double) {});
    Point &node = points[hexes[star[0] / 8][star[0] % 8]];
    node[0] += alpha * chosen.d.x / scale;
    node[1] += alpha * chosen.d.y / scale;
    node[2] += alpha * chosen.d.z / scale;
}

// The most hexes that meet at one of `nodes`.
inline std::int64_t most_at(Indices start, Indices nodes) {
    std::int32_t most = 0;
    for (auto i : nodes) most = std::max(most, start[i + 1] - start[i]);
    return most;
}

// Nodes that one thread takes at a time.
constexpr std::int64_t NODES = 64;

template <bool soft, class T>
void sweep_of(std::span<Point> points, Hexes hexes, Indices start, Indices corners, Indices groups, Indices nodes,
              const LocalStep &how) {
    std::int64_t most = most_at(start, nodes);
    for (std::size_t g = 0; g + 1 < groups.size(); ++g) {
        auto group = nodes.subspan(groups[g], groups[g + 1] - groups[g]);
        parallel_chunks(group.size(), NODES, [&](std::int64_t begin, std::int64_t end) {
            Patch<T> patch(most);
            for (std::int64_t k = begin; k < end; ++k) {
                auto i = group[k];
                visit<soft>(patch, points, hexes, corners.subspan(start[i], start[i + 1] - start[i]), how);
            }
        });
    }
}

}  // namespace hexmend
