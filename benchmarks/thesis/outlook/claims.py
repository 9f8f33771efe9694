"""Claims of sections 3.2.2 and 5.2 of the thesis about variants of its methods, judged by measured figures."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

from benchmarks.thesis.claims.claim import Claim, Finding, claim, tally
from benchmarks.thesis.outlook.experiments import Point, TrialResult, Variant

#: An order is faster if it arrives after less than this share of the sweeps in natural order.
_FASTER = 0.9

#: More steps at a node are economical if they save more than this factor of the evaluations.
_ECONOMICAL = 1.05


@claim("3.2.2", "Several steps at a node before the next are not economical.")
def steps_per_node(trials: Sequence[TrialResult]) -> Finding:
    """3.2.2: one step at a node against more, by evaluations of a hex until near the optimum."""
    cases = []
    for trial in _of_section(trials, "3.2.2"):
        for method in trial.outlook.methods:
            arrivals = _arrivals(trial, method, "steps_per_node")
            if 1 in arrivals and len(arrivals) > 1:
                fewest = min(arrivals.values(), key=lambda point: point.evaluations)
                each = ", ".join(
                    f"{steps} {point.evaluations:.3g} ({point.iteration} sweeps, {point.seconds:.2g} s)"
                    for steps, point in arrivals.items()
                )
                details = f"{trial.outlook.mesh}, {trial.initial.hexes:,} hexes, {method}: {each}"
                cases.append((arrivals[1].evaluations <= _ECONOMICAL * fewest.evaluations, details))
    return tally(cases, "No method arrived with one step at a node and with more.", most=True)


@claim(
    "5.2.5",
    "Patches of connected nodes, one after another, are a more efficient middle ground of local and global steps.",
)
def middle_ground(trials: Sequence[TrialResult]) -> Finding:
    """5.2.5: the fastest of the patches of several nodes against one node at a time, and all nodes at once."""
    details, faster = [], []
    for trial in _of_section(trials, "5.2.5"):
        patches = [run for run in trial.variants if run.values.get("patch", 0) > 1]
        fewest, fastest = _first(trial, patches, _sweeps), _first(trial, patches, _seconds)
        extremes = [(name, _arrival(trial, trial.find(name))) for name in ("local-nr", "global-nr")]
        single = _arrival(trial, trial.find("local-patch", overlap=0, patch=1))
        if fewest is None or fastest is None or single is None or any(point is None for _, point in extremes):
            continue
        (few, few_point), (fast, fast_point) = fewest, fastest
        faster.append(all(fast_point.seconds < point.seconds for _, point in extremes))
        others = ", ".join(f"{name} {point.seconds:.2g} s" for name, point in extremes)
        details.append(
            f"{trial.outlook.mesh}, {trial.initial.hexes:,} hexes: {_describe(few)} takes {few_point.iteration} sweeps "
            f"in place of {single.iteration} and {few_point.evaluations:.3g} evaluations a hex in place of "
            f"{single.evaluations:.3g}; the fastest, {_describe(fast)}, {fast_point.seconds:.2g} s, {others}"
        )
    if not faster:
        return None, "Patches, and one node and all nodes at a time, did not all arrive on a mesh."
    return all(faster), f"Until 0.1 % above the optimum. {'. '.join(details)}."


@claim("5.2.6", "Visiting levels of nodes from the boundary inward takes fewer sweeps.")
def from_the_boundary(trials: Sequence[TrialResult]) -> Finding:
    """5.2.6: the order inward against the natural one, which the thesis takes, by sweeps, for the optimisers."""
    details, faster = [], []
    for trial in _of_section(trials, "5.2.6"):
        for method in trial.outlook.methods:
            sweeps = {order: point.iteration for order, point in _arrivals(trial, method, "order").items()}
            if not {"inward", "natural"} <= sweeps.keys():
                continue
            faster.append(sweeps["inward"] < _FASTER * sweeps["natural"])
            each = ", ".join(f"{order} {count}" for order, count in sweeps.items())
            details.append(f"{trial.outlook.mesh}, {trial.initial.hexes:,} hexes, {method}: {each}")
    if not faster:
        return None, "No method arrived in both orders, inward and natural."
    text = f"So in {sum(faster)} of {len(faster)} cases. Sweeps until 0.1 % above the optimum. {'. '.join(details)}."
    return sum(faster) > len(faster) / 2, text


#: All expectations, in the order of the report.
OUTLOOK_CLAIMS: tuple[Callable[[Sequence[TrialResult]], Claim], ...] = (
    steps_per_node,
    middle_ground,
    from_the_boundary,
)


def _of_section(trials: Sequence[TrialResult], section: str) -> Iterator[TrialResult]:
    return (trial for trial in trials if trial.outlook.section == section)


def _arrival(trial: TrialResult, run: Variant | None) -> Point | None:
    optimum = trial.optimum
    return None if run is None or optimum is None else run.arrival(optimum)


def _arrivals(trial: TrialResult, method: str, key: str) -> dict[Any, Point]:
    """Return the arrivals of a method's runs by a varied parameter, of those that arrived."""
    runs = {run.values[key]: _arrival(trial, run) for run in trial.variants if run.row.method == method}
    return {value: point for value, point in runs.items() if point is not None}


def _first(trial: TrialResult, runs: Iterable[Variant], key: Callable[[Point], Any]) -> tuple[Variant, Point] | None:
    """Return the run of the smallest key of its arrival, with the arrival; None if no run arrived."""
    arrived = [(run, point) for run in runs if (point := _arrival(trial, run)) is not None]
    return min(arrived, key=lambda pair: key(pair[1]), default=None)


def _sweeps(point: Point) -> tuple[int, float]:
    return point.iteration, point.seconds


def _seconds(point: Point) -> float:
    return point.seconds


def _describe(run: Variant) -> str:
    """Describe the patches of a run."""
    return f"k = {run.values['patch']} with overlap {run.values['overlap']}"
