"""What the thesis hopes for in section 5.2, each hope judged by our own figures."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

from hexmend.study.claims.claim import Claim, Finding, judges
from hexmend.study.outlook.experiments import Point, TrialResult, Variant

#: An order pays where it arrives after less than this share of the sweeps by colour.
_PAYS = 0.9


@judges(
    "5.2.5",
    "Patches of connected nodes, one after another, are a more efficient middle ground of local and global steps.",
)
def middle_ground(tried: Sequence[TrialResult]) -> Finding:
    """5.2.5: the fastest of the patches of several nodes against one node at a time, and all nodes at once."""
    told, faster = [], []
    for one in _of_section(tried, "5.2.5"):
        patches = [run for run in one.variants if run.values.get("patch", 0) > 1]
        fewest, quickest = _first(one, patches, _sweeps), _first(one, patches, _seconds)
        extremes = [(name, _arrival(one, one.find(name))) for name in ("local-nr", "global-nr")]
        single = _arrival(one, one.find("local-patch", overlap=0, patch=1))
        if fewest is None or quickest is None or single is None or any(point is None for _, point in extremes):
            continue
        (few, few_point), (quick, quick_point) = fewest, quickest
        faster.append(all(quick_point.seconds < point.seconds for _, point in extremes))
        others = ", ".join(f"{name} {point.seconds:.2g} s" for name, point in extremes)
        told.append(
            f"{one.outlook.mesh}, {one.initial.hexes:,} hexes: {_told(few)} takes {few_point.iteration} sweeps in "
            f"place of {single.iteration} and {few_point.evaluations:.3g} evaluations a hex in place of "
            f"{single.evaluations:.3g}; the quickest, {_told(quick)}, {quick_point.seconds:.2g} s, {others}"
        )
    if not faster:
        return None, "Patches, and one node and all nodes at a time, did not all arrive on a mesh."
    return all(faster), f"Until 0.1 % above the optimum. {'. '.join(told)}."


@judges("5.2.6", "Visiting levels of nodes from the boundary inward takes fewer sweeps.")
def from_the_boundary(tried: Sequence[TrialResult]) -> Finding:
    """5.2.6: the order inward against that by colour, by sweeps, for the methods that go to an optimum."""
    told, pays = [], []
    for one in _of_section(tried, "5.2.6"):
        for method in one.outlook.methods:
            arrivals = {run.values["order"]: _arrival(one, run) for run in one.variants if run.row.method == method}
            sweeps = {order: point.iteration for order, point in arrivals.items() if point is not None}
            if not {"inward", "colour"} <= sweeps.keys():
                continue
            pays.append(sweeps["inward"] < _PAYS * sweeps["colour"])
            each = ", ".join(f"{order} {count}" for order, count in sweeps.items())
            told.append(f"{one.outlook.mesh}, {one.initial.hexes:,} hexes, {method}: {each}")
    if not pays:
        return None, "No method arrived in both orders, inward and by colour."
    told_all = f"So in {sum(pays)} of {len(pays)} cases. Sweeps until 0.1 % above the optimum. {'. '.join(told)}."
    return sum(pays) > len(pays) / 2, told_all


#: Every hope, in the order of the report.
OUTLOOK_CLAIMS: tuple[Callable[[Sequence[TrialResult]], Claim], ...] = (middle_ground, from_the_boundary)


def _of_section(tried: Sequence[TrialResult], section: str) -> Iterator[TrialResult]:
    return (one for one in tried if one.outlook.section == section)


def _arrival(one: TrialResult, run: Variant | None) -> Point | None:
    optimum = one.optimum
    return None if run is None or optimum is None else run.arrival(optimum)


def _first(one: TrialResult, runs: Iterable[Variant], key: Callable[[Point], float]) -> tuple[Variant, Point] | None:
    """The run that arrived with the least of something, and its arrival; None where none did."""
    arrived = [(run, point) for run in runs if (point := _arrival(one, run)) is not None]
    return min(arrived, key=lambda pair: key(pair[1]), default=None)


def _sweeps(point: Point) -> tuple[int, float]:
    return point.iteration, point.seconds


def _seconds(point: Point) -> float:
    return point.seconds


def _told(run: Variant) -> str:
    """The values that make a run of patches, in words."""
    return f"k = {run.values['patch']} with overlap {run.values['overlap']}"
