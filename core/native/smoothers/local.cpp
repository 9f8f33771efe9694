#include "smoothers/local.hpp"

#include "smoothers/node_step.hpp"

namespace hexmend {
namespace {

template <class Target> NodePatch<Lanes, Target> patch_of(Star star, const Target &target) {
    expect(!star.empty(), "a node that no hex uses has no patch");
    return {static_cast<std::int64_t>(star.size()), target};
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
    return local_sweep_in<Lanes>(points, mesh, groups, nodes, settings);
}

PatchEnergy patch_energy(Points points, Hexes hexes, Indices star, double factor, double delta, ObjectiveNorm norm,
                         const TargetMatrices *target) {
    expect_rows(target, hexes.size());
    return with_cases(target, delta, [&](auto soft, const auto &matrices) -> PatchEnergy {
        auto patch = patch_of(star, matrices);
        double scaled_by = patch.load(points, hexes, star, factor);
        patch.template tabulate<soft>(delta);
        ValueAndGradient at = patch.template value_and_gradient<soft>(delta, norm);
        SymmetricMatrix h = patch.hessian();
        return {scaled_by, at.value, point(at.gradient), {h.xx, h.xy, h.xz, h.yy, h.yz, h.zz}};
    });
}

RecordedStep recorded_step(Points points, Hexes hexes, Indices star, const NodeStepSettings &settings) {
    expect_rows(settings.target, hexes.size());
    StepRecorder recorder;
    with_cases(settings.target, settings.delta, [&](auto soft, const auto &target) {
        decltype(patch_of(star, target)) patch[]{patch_of(star, target)};
        step_nodes<soft>(patch, points, hexes, {star}, settings, recorder);
    });
    return std::move(recorder.step);
}

void energy_along(Points points, Hexes hexes, Indices star, double factor, std::array<double, 3> direction,
                  double delta, ObjectiveNorm norm, std::span<std::array<double, 2>> curve,
                  const TargetMatrices *target) {
    expect_rows(target, hexes.size());
    with_cases(target, delta, [&](auto soft, const auto &matrices) {
        auto patch = patch_of(star, matrices);
        patch.load(points, hexes, star, factor);
        patch.template tabulate<soft>(delta);
        patch.set_direction(vector(direction));
        for (auto &[alpha, value] : curve) value = patch.template value_along<soft>(alpha, delta, norm);
    });
}

}  // namespace hexmend
