// One step of local optimisation at a node, Algorithms A.2 to A.5 on its patch, and sweeps of such steps.
#pragma once

#include <atomic>

#include "energy/node_patch.hpp"
#include "smoothers/local.hpp"

namespace hexmend {

// Search direction d at a node and the derivative of the patch's energy along it.
struct SearchDirection {
    V3<double> d;
    double slope;
    double shift;   // added to the eigenvalues of the Hessian by Algorithm A.4
    bool fallback;  // steepest descent, because Newton's direction did not descend
};

// Algorithm A.2: p_k = -grad of the p-th root of f, the objective (3.3) of the patch.
inline V3<double> steepest_descent(double f, const V3<double> &gradient, double p) {
    double factor = p == 2 ? -0.5 / std::sqrt(f) : -std::pow(f, 1 / p - 1) / p;  // (C.2)
    return factor * gradient;
}

// Algorithm A.4: the shift that makes the smallest eigenvalue at least a thousandth of the largest.
inline double eigenvalue_shift(const SymmetricMatrix &hessian) {
    auto [smallest, largest] = extreme_eigenvalues(hessian);
    return smallest < 0.001 * largest ? 0.001 * largest - smallest : 0.0;
}

// Algorithms A.3 and A.4: (H + shift I) p_k = -grad f.
inline V3<double> newton_direction(SymmetricMatrix hessian, const V3<double> &gradient, double shift) {
    if (shift > 0) hessian.add_to_diagonal(shift);
    return solve(hessian, -gradient);
}

// Direction of the method in `settings`; steepest descent where Newton's direction does not descend.
//
// value and gradient are those of the patch's energy; hessian() returns its second derivatives, slope(d) its derivative
// along d. All three may be restricted to the tangents of a surface. Not inlined: contracted sums then have the same
// bits whether one node or several are stepped at a time.
template <class Hessian, class Slope>
__attribute__((noinline)) SearchDirection choose_direction(double value, const V3<double> &gradient,
                                                           const NodeStepSettings &settings, const Hessian &hessian,
                                                           const Slope &slope) {
    SearchDirection chosen{};
    if (settings.direction != STEEPEST_DESCENT) {
        SymmetricMatrix h = hessian();
        if (settings.direction == MODIFIED_NEWTON) chosen.shift = eigenvalue_shift(h);
        chosen.d = newton_direction(h, gradient, chosen.shift);
        chosen.slope = slope(chosen.d);
    }
    if (!(chosen.slope < 0)) {
        chosen.fallback = settings.direction != STEEPEST_DESCENT;
        chosen.d = steepest_descent(value, gradient, settings.norm.p);
        chosen.slope = slope(chosen.d);
    }
    return chosen;
}

// The node whose corners `star` holds.
inline Node node_of(Hexes hexes, Star star) { return hexes[star[0] / 8][star[0] % 8]; }

// Take a step at each of `nodes` nodes, which share no hex.
//
// Stages are interleaved: while the roots and quotients of one node are pending, the processor works on another. The
// observer is called with each trial of the line search, on_trial(hexes, alpha, value, bound), and with the end of each
// step: on_rejected(status, direction) or on_moved(node, point, direction, alpha).
template <bool soft, class T, class Target, int nodes, class Observer>
inline void step_nodes(NodePatch<T, Target> (&patch)[nodes], Points points, Hexes hexes, const Star (&star)[nodes],
                       const NodeStepSettings &settings, Observer &&observer) {
    double scale[nodes];
    ValueAndGradient at[nodes];
    for (int k = 0; k < nodes; ++k) scale[k] = patch[k].load(points, hexes, star[k]);
    for (int k = 0; k < nodes; ++k) patch[k].template tabulate<soft>(settings.delta);
    for (int k = 0; k < nodes; ++k) at[k] = patch[k].template value_and_gradient<soft>(settings.delta, settings.norm);
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
        SearchDirection chosen = choose_direction(
            at[k].value, g, settings, [&] { return patch[k].hessian(); },
            [&](const V3<double> &d) { return dot(g, d); });
        const V3<double> &d = chosen.d;
        patch[k].set_direction(d);
        double alpha = settings.search(at[k].value, chosen.slope, [&](double alpha, double bound) {
            double value = patch[k].template value_along<soft>(alpha, settings.delta, settings.norm);
            observer.on_trial(patch[k].size(), alpha, value, bound);
            return value;
        });
        if (alpha == 0) {
            observer.on_rejected(NO_DESCENT, chosen);
            continue;
        }
        Node node = node_of(hexes, star[k]);
        const Point &from = points[node];
        observer.on_moved(
            node,
            {from[0] + alpha * d.x / scale[k], from[1] + alpha * d.y / scale[k], from[2] + alpha * d.z / scale[k]},
            chosen, alpha);
    }
}

// Observer of a sweep: moves the nodes and counts the evaluations of a hex's energy in line searches.
struct NodeMover {
    std::span<Point> points;
    std::int64_t evaluations = 0;

    void on_trial(int hexes, double, double, double) { evaluations += hexes; }
    void on_rejected(StepStatus, const SearchDirection & = {}) {}
    void on_moved(Node node, const Point &place, const SearchDirection &, double) { points[node] = place; }
};

// Throw unless the arguments of a sweep fit each other.
inline void expect_sweep(Points points, const HexMesh &mesh, Indices groups, Indices nodes,
                         const NodeStepSettings &settings) {
    expect_points(mesh, points);
    expect(are_csr(groups, nodes.size()), "groups: its last number is expected to be the length of nodes");
    expect_rows(settings.target, mesh.hexes.size());
}

// The largest number of hexes at one of `nodes`.
inline std::int64_t largest_star(const HexMesh &mesh, Indices nodes) {
    std::size_t most = 0;
    for (Node i : nodes) most = std::max(most, mesh.star(i).size());
    return most;
}

// Nodes that one thread takes at a time.
constexpr std::int64_t NODES_PER_CHUNK = 64;

// Nodes whose steps are interleaved.
constexpr int INTERLEAVED = 2;

// Group after group of nodes (group k: nodes[groups[k]] to nodes[groups[k + 1] - 1], which share no hex): call
// body(chunk of the group) on all threads; returns the sum of what body returns.
template <class Body> std::int64_t sum_over_groups(Indices groups, Indices nodes, const Body &body) {
    std::atomic<std::int64_t> total = 0;
    for (std::size_t g = 0; g + 1 < groups.size(); ++g) {
        auto group = nodes.subspan(groups[g], groups[g + 1] - groups[g]);
        parallel_chunks(group.size(), NODES_PER_CHUNK, [&](std::int64_t begin, std::int64_t end) {
            total += body(group.subspan(begin, end - begin));
        });
    }
    return total;
}

// `local_sweep`: with vectors for T = Lanes, one hex after another for T = double.
template <class T>
std::int64_t local_sweep_in(std::span<Point> points, const HexMesh &mesh, Indices groups, Indices nodes,
                            const NodeStepSettings &settings) {
    expect_sweep(points, mesh, groups, nodes, settings);
    std::int64_t most = largest_star(mesh, nodes);
    return with_cases(settings.target, settings.delta, [&](auto soft, const auto &target) {
        using Patch = NodePatch<T, std::remove_cvref_t<decltype(target)>>;
        return sum_over_groups(groups, nodes, [&](Indices chunk) {
            Patch alone[1]{{most, target}}, several[INTERLEAVED]{{most, target}, {most, target}};
            auto star = [&](std::size_t k) { return mesh.star(chunk[k]); };
            NodeMover mover{points};
            std::size_t k = 0;
            if constexpr (width<T> > 1)
                for (; k + INTERLEAVED <= chunk.size(); k += INTERLEAVED)
                    step_nodes<soft>(several, points, mesh.hexes, {star(k), star(k + 1)}, settings, mover);
            for (; k < chunk.size(); ++k) step_nodes<soft>(alone, points, mesh.hexes, {star(k)}, settings, mover);
            return mover.evaluations;
        });
    });
}

}  // namespace hexmend
