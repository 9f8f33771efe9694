"""Conclusions of the thesis from Chapter 4, judged by measured figures."""

from collections.abc import Callable, Sequence

from hexmend.study.claims import (
    cost,
    delta,
    global_methods,
    heuristics,
    local_methods,
    optimum,
    preconditioning,
    robustness,
)
from hexmend.study.claims.claim import Claim
from hexmend.study.thesis.experiment_result import ExperimentResult

#: All claims, in the order of the report.
CLAIMS: tuple[Callable[[Sequence[ExperimentResult]], Claim], ...] = (
    optimum.same_optimum,
    optimum.same_optimum_untangled,
    optimum.norm_is_objective,
    optimum.one_quality,
    optimum.optimum_is_best,
    optimum.better_minimum,
    optimum.heuristics_not_optimal,
    heuristics.getme_between,
    heuristics.heuristics_faster,
    heuristics.laplacian_inverts,
    heuristics.laplacian_lowers_mean,
    heuristics.getme_against_laplacian,
    heuristics.getme_cheaper,
    heuristics.sequential_raises_minimum,
    preconditioning.preconditioning_speeds,
    preconditioning.preconditioning_compensates,
    preconditioning.preconditioning_in_vain,
    local_methods.local_sd_fastest,
    local_methods.local_sd_best_of_local,
    local_methods.modified_local,
    global_methods.newton_best_of_global,
    global_methods.modified_global,
    global_methods.fewer_iterations,
    global_methods.competitive,
    global_methods.global_sd_slow,
    global_methods.global_sd_smallest,
    global_methods.global_sd_bridge,
    global_methods.minres_suffices,
    robustness.several_fail,
    robustness.unsuitable_on_plane,
    robustness.less_robust,
    robustness.practical_issues,
    delta.small_delta_harms,
    local_methods.direct_solver,
    delta.large_delta_moves,
    delta.large_delta_local,
    delta.delta_idle,
    cost.cost_constant,
    cost.scaling_alike,
)

__all__ = ["CLAIMS", "Claim"]
