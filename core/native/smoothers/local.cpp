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
class StepRecorder {
  public:
    RecordedStep step{};

    void on_trial(int, double alpha, double value, double bound) {
        for (double number : {alpha, value, bound}) step.trials.values.push_back(number);
    }
    void on_rejected(StepStatus reason, const SearchDirection &chosen = {}) { set(reason, chosen); }
    void on_moved(Node, const Point &place, const SearchDirection &chosen, double alpha) {
        set(MOVED, chosen);
        step.alpha = alpha, step.place = place;
    }

  private:
    void set(StepStatus status, const SearchDirection &chosen) {
        step.status = status;
        step.direction = point(chosen.d);
        step.slope = chosen.slope, step.shift = chosen.shift, step.fallback = chosen.fallback;
    }
};

}  // namespace

std::int64_t local_sweep(std::span<Point> points, const HexMesh &mesh, Indices groups, Indices nodes,
                         const NodeStepSettings &settings) {
    return (settings.delta != 0 ? local_sweep_of<true, Lanes> : local_sweep_of<false, Lanes>)(points, mesh, groups,
                                                                                              nodes, settings);
}

PatchEnergy patch_energy(Points points, Hexes hexes, Indices star, double factor, double delta, ObjectiveNorm norm) {
    auto patch = patch_of(star);
    factor = patch.load(points, hexes, star, factor);
    ValueAndGradient at = delta != 0 ? evaluated<true>(patch, delta, norm) : evaluated<false>(patch, delta, norm);
    SymmetricMatrix h = patch.hessian();
    return {factor, at.value, point(at.gradient), {h.xx, h.xy, h.xz, h.yy, h.yz, h.zz}};
}

RecordedStep recorded_step(Points points, Hexes hexes, Indices star, const NodeStepSettings &settings) {
    NodePatch<Lanes> patch[]{patch_of(star)};
    StepRecorder recorder;
    settings.delta != 0 ? step_nodes<true>(patch, points, hexes, {star}, settings, recorder)
                        : step_nodes<false>(patch, points, hexes, {star}, settings, recorder);
    return std::move(recorder.step);
}

void energy_along(Points points, Hexes hexes, Indices star, double factor, std::array<double, 3> direction,
                  double delta, ObjectiveNorm norm, std::span<std::array<double, 2>> curve) {
    auto patch = patch_of(star);
    patch.load(points, hexes, star, factor);
    delta != 0 ? patch.tabulate<true>(delta) : patch.tabulate<false>(delta);
    patch.set_direction(vector(direction));
    for (auto &[alpha, value] : curve)
        value = delta != 0 ? patch.value_along<true>(alpha, delta, norm) : patch.value_along<false>(alpha, delta, norm);
}

}  // namespace hexmend
