"""Claims of how the time of an iteration grows with the mesh, Figure 4.4."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from hexmend.study.claims.claim import Finding, judges
from hexmend.study.claims.reading import arrived, of_mesh
from hexmend.study.thesis.experiment_result import ExperimentResult

#: "Constant in the mesh size": within this factor. The thesis's own figures of global-sd vary by 3.4.
_CONSTANT = 3.5

#: "Not noticeably worse": exponents of growth that are higher by less than this. By the thesis's own times they are 1.0
#: to 1.1, but for 1.4 of global-sd, which mostly failed.
_NOTICEABLE = 0.2


@judges("4.3.1", "Time per iteration and free node does not depend on the mesh's size.")
def cost_constant(measured: Sequence[ExperimentResult]) -> Finding:
    """4.3.1, Figure 4.4."""
    ours: dict[str, dict[int, float]] = {}
    thesis: dict[str, dict[int, float]] = {}
    for one in of_mesh(measured, "five-side"):
        for name, row in one.rows.items():
            if row.seconds_per_iteration_and_node is not None:
                ours.setdefault(name, {})[one.initial.free_nodes] = row.seconds_per_iteration_and_node
        for name, figures in one.experiment.published.items():
            if "seconds_per_iteration_and_node" in figures:
                cost = figures["seconds_per_iteration_and_node"]
                thesis.setdefault(name, {})[one.experiment.free_nodes] = cost
    ratios = {name: _spread(by) for name, by in ours.items() if len(by) > 1}
    if not ratios:
        return None, "Fewer than two sizes were measured."
    sizes = sorted({size for by in ours.values() for size in by})
    told = ", ".join(
        f"{name} {ratio:.2g}" + (f" ({_spread(thesis[name]):.2g})" if name in thesis else "")
        for name, ratio in ratios.items()
    )
    told = (
        f"From {sizes[0]:,} to {sizes[-1]:,} free nodes the largest is so many times the smallest, in brackets by the "
        f"thesis's figures: {told}. Constant is taken as less than {_CONSTANT:g}."
    )
    return max(ratios.values()) < _CONSTANT, told


@judges("4.3.1", "Where global methods succeed, they scale not noticeably worse than local or heuristic ones.")
def scaling_alike(measured: Sequence[ExperimentResult]) -> Finding:
    """4.3.1, Figure 4.4: by the slopes of seconds per iteration over free nodes, both as logarithms."""
    costs: dict[str, dict[int, float]] = {}
    for one in of_mesh(measured, "five-side"):
        for name, row in one.rows.items():
            fails = name.startswith("global-") and not arrived(one, row)
            if row.seconds_per_iteration is not None and not fails:
                costs.setdefault(name, {})[one.initial.free_nodes] = row.seconds_per_iteration
    slopes = {name: _slope(by) for name, by in costs.items() if len(by) > 1}
    everywhere, others = (
        {name: slope for name, slope in slopes.items() if (name.startswith("global-")) is kind}
        for kind in (True, False)
    )
    if not everywhere or not others:
        return None, "Global methods and others did not both succeed on two sizes."
    told = ", ".join(f"{name} {slope:.2f}" for name, slope in slopes.items())
    worse = max(everywhere.values()) - max(others.values())
    return worse < _NOTICEABLE, f"Time per iteration grows with the power of the free nodes: {told}."


def _spread(by_size: Mapping[int, float]) -> float:
    return max(by_size.values()) / min(by_size.values())


def _slope(by_size: Mapping[int, float]) -> float:
    return float(np.polyfit(np.log(list(by_size)), np.log(list(by_size.values())), 1)[0])
