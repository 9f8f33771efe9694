#include "smoothers/local.hpp"

#include "smoothers/node_step.hpp"

namespace hexmend {
namespace {

NodePatch<Lanes> patch_of(Star star) {
    expect(!star.empty(), "a node that no hex uses has no patch");
    return NodePatch<Lanes>(star.size());
}

template <bool soft> ValueAndGradient evaluated(NodePatch<Lanes> &patch, double delta, ObjectiveNorm norm) {
    patch.tabulate<soft>(delta);
    return patch.value_and_gradient<soft>(delta, norm);
}

// Observer that records the step at one node.
struct StepRecord {
    StepStatus status;
    SearchDirection chosen{};
    double alpha = 0;
    Point place{};
    OwnedArray<double, 3> trials;

    void on_trial(int, double alpha, double value, double bound) {
        for (double number : {alpha, value, bound}) trials.values.push_back(number);
    }
    void on_rejected(StepStatus reason, const SearchDirection &direction = {}) { status = reason, chosen = direction; }
    void on_moved(Node, const Point &there, const SearchDirection &direction, double step) {
        status = MOVED, chosen = direction, alpha = step, place = there;
    }
};

}  // namespace

std::int64_t sweep(std::span<Point> points, const HexMesh &mesh, Indices groups, Indices nodes,
                   const NodeStepSettings &settings) {
    return (settings.delta != 0 ? sweep_of<true, Lanes> : sweep_of<false, Lanes>)(points, mesh, groups, nodes,
                                                                                  settings);
}

std::tuple<double, double, std::array<double, 3>, std::array<double, 6>> patch_energy(Points points, Hexes hexes,
                                                                                      Indices star, double factor,
                                                                                      double delta,
                                                                                      ObjectiveNorm norm) {
    auto patch = patch_of(star);
    factor = patch.load(points, hexes, star, factor);
    ValueAndGradient at = delta != 0 ? evaluated<true>(patch, delta, norm) : evaluated<false>(patch, delta, norm);
    SymmetricMatrix h = patch.hessian();
    return {factor, at.value, {at.gradient.x, at.gradient.y, at.gradient.z}, {h.xx, h.xy, h.xz, h.yy, h.yz, h.zz}};
}

std::tuple<int, std::array<double, 3>, double, bool, double, double, std::array<double, 3>, OwnedArray<double, 3>>
recorded_step(Points points, Hexes hexes, Indices star, const NodeStepSettings &settings) {
    NodePatch<Lanes> patch[]{patch_of(star)};
    StepRecord record;
    settings.delta != 0 ? step_nodes<true>(patch, points, hexes, {star}, settings, record)
                        : step_nodes<false>(patch, points, hexes, {star}, settings, record);
    const auto &[d, slope, shift, fallback] = record.chosen;
    return {record.status, {d.x, d.y, d.z}, slope,        fallback,
            shift,         record.alpha,    record.place, std::move(record.trials)};
}

void energy_along(Points points, Hexes hexes, Indices star, double factor, std::array<double, 3> direction,
                  double delta, ObjectiveNorm norm, std::span<std::array<double, 2>> curve) {
    auto patch = patch_of(star);
    patch.load(points, hexes, star, factor);
    delta != 0 ? patch.tabulate<true>(delta) : patch.tabulate<false>(delta);
    patch.set_direction({direction[0], direction[1], direction[2]});
    for (auto &[alpha, value] : curve)
        value = delta != 0 ? patch.value_along<true>(alpha, delta, norm) : patch.value_along<false>(alpha, delta, norm);
}

}  // namespace hexmend
