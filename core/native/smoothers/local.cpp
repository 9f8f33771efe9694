#include "smoothers/local.hpp"

#include <stdexcept>

#include "smoothers/node_step.hpp"

namespace hexmend {
namespace {

// A patch that is to be looked at alone.
NodePatch<Lanes> patch_of(Star star) {
    if (star.empty()) throw std::invalid_argument("a node that no hex uses has no patch");
    return NodePatch<Lanes>(star.size());
}

// A patch with its table, and what a method sees where the node is.
template <bool soft>
ValueAndGradient value_and_gradient_at(NodePatch<Lanes> &patch, double delta, ObjectiveNorm power) {
    patch.tabulate<soft>(delta);
    return patch.value_and_gradient<soft>(delta, power);
}

// Writes down what becomes of the one node that is visited.
struct StepRecord {
    StepStatus verdict;
    SearchDirection chosen{};
    double alpha = 0;
    Point place{};
    OwnedArray<double, 3> trials;

    void on_trial(int, double alpha, double value, double bound) {
        for (double number : {alpha, value, bound}) trials.values.push_back(number);
    }
    void on_rejected(StepStatus why, const SearchDirection &how = {}) { verdict = why, chosen = how; }
    void on_moved(std::int32_t, const Point &there, const SearchDirection &how, double far) {
        verdict = MOVED, chosen = how, alpha = far, place = there;
    }
};

}  // namespace

std::int64_t sweep(std::span<Point> points, Hexes hexes, Indices start, Indices corners, Indices groups, Indices nodes,
                   int direction, double delta, ObjectiveNorm power, double first, double shrink, double c1, int cuts) {
    LocalStep how{direction, delta, power, first, shrink, c1, cuts};
    return (delta != 0 ? sweep_of<true, Lanes> : sweep_of<false, Lanes>)(points, hexes, start, corners, groups, nodes,
                                                                         how);
}

std::tuple<double, double, std::array<double, 3>, std::array<double, 6>> look(Points points, Hexes hexes, Indices star,
                                                                              double factor, double delta,
                                                                              ObjectiveNorm power) {
    auto patch = patch_of(star);
    factor = patch.load(points, hexes, star, factor);
    ValueAndGradient at = delta != 0 ? value_and_gradient_at<true>(patch, delta, power)
                                     : value_and_gradient_at<false>(patch, delta, power);
    SymmetricMatrix h = patch.hessian();
    return {factor, at.value, {at.gradient.x, at.gradient.y, at.gradient.z}, {h.xx, h.xy, h.xz, h.yy, h.yz, h.zz}};
}

std::tuple<int, std::array<double, 3>, double, bool, double, double, std::array<double, 3>, OwnedArray<double, 3>>
visit(Points points, Hexes hexes, Indices star, int direction, double delta, ObjectiveNorm power, double first,
      double shrink, double c1, int cuts) {
    LocalStep how{direction, delta, power, first, shrink, c1, cuts};
    NodePatch<Lanes> patch[]{patch_of(star)};
    StepRecord record;
    delta != 0 ? visit<true>(patch, points, hexes, {star}, how, record)
               : visit<false>(patch, points, hexes, {star}, how, record);
    const auto &[d, slope, shift, fallback] = record.chosen;
    return {record.verdict, {d.x, d.y, d.z}, slope,        fallback,
            shift,          record.alpha,    record.place, std::move(record.trials)};
}

void along(Points points, Hexes hexes, Indices star, double factor, std::array<double, 3> direction, double delta,
           ObjectiveNorm power, std::span<std::array<double, 2>> curve) {
    auto patch = patch_of(star);
    patch.load(points, hexes, star, factor);
    delta != 0 ? patch.tabulate<true>(delta) : patch.tabulate<false>(delta);
    patch.set_direction({direction[0], direction[1], direction[2]});
    for (auto &[alpha, value] : curve)
        value =
            delta != 0 ? patch.value_along<true>(alpha, delta, power) : patch.value_along<false>(alpha, delta, power);
}

}  // namespace hexmend
