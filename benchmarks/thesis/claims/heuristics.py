"""Claims about Laplacian smoothing and GETMe."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from benchmarks.thesis.claims.claim import Finding, claim, tally
from benchmarks.thesis.claims.queries import (
    converged_runs,
    of_mesh,
    optimal_runs,
    published,
    seconds_of,
    title,
    with_rows,
)
from benchmarks.thesis.experiment_result import ExperimentResult
from hexmend.quality import measure

#: "An order of magnitude".
_ORDER = 10.0


@claim("4.4.1", "On plane GETMe raises the least and the mean quality, but not as much as optimisation.")
def getme_between(results: Sequence[ExperimentResult]) -> Finding:
    """4.4.1, Table 4.14."""
    for result, getme in with_rows(of_mesh(results, "plane", "initial"), "getme"):
        if found := converged_runs(result):
            top = found[0]
            three = result.initial, getme.after, top.after
            least, mean = [summary.q_min for summary in three], [summary.q_mean for summary in three]
            details = (
                f"q min is {least[0]:.4f} at the start, {least[1]:.4f} by getme, {least[2]:.4f} by {top.method} "
                f"({top.after.inverted:,} inverted); q mean is {mean[0]:.4f}, {mean[1]:.4f}, {mean[2]:.4f}."
            )
            return least[0] < least[1] < least[2] and mean[0] < mean[1] < mean[2], details
    return None, "GETMe and an optimiser that converges were not both run on plane."


@claim(
    "4.4.1",
    "On plane the heuristics converge much more rapidly: the fastest optimiser, local steepest descent, is more than "
    "an order of magnitude slower than the slower of them, GETMe.",
)
def heuristics_faster(results: Sequence[ExperimentResult]) -> Finding:
    """4.4.1, Table 4.15."""
    for result, *rows in with_rows(of_mesh(results, "plane", "initial"), "laplacian", "getme"):
        if found := optimal_runs(result):
            slowest, fastest = max(row.seconds for row in rows), found[0]
            ratio = fastest.seconds / slowest
            details = f"{seconds_of([*rows, *found])}: the fastest optimiser takes {ratio:.2g} times as long."
            return fastest.method == "local-sd" and fastest.seconds > _ORDER * slowest, details
    return None, "The heuristics and an optimiser that converges were not all run on plane."


@claim("4.2, 4.4.1", "Laplacian smoothing inverts hexes on bridge-sharp and on plane.")
def laplacian_inverts(results: Sequence[ExperimentResult]) -> Finding:
    """4.2, 4.4.1: judged by the hexes that were valid before, on the largest of the meshes."""
    found: dict[str, tuple[int, int]] = {}
    meshes = itertools.chain(of_mesh(results, "bridge-sharp"), of_mesh(results, "plane"))
    for result, row in with_rows(meshes, "laplacian"):
        if result.initial.hexes > found.get(result.experiment.mesh, (0, 0))[0]:
            before, after = (measure(mesh.points, mesh.hexes).inverted for mesh in (result.mesh, row.mesh))
            found[result.experiment.mesh] = result.initial.hexes, int(np.count_nonzero(after & ~before))
    details = "; ".join(f"{mesh}, {hexes:,} hexes: {count:,} valid ones" for mesh, (hexes, count) in found.items())
    if len(found) < 2:
        return None, f"Only one of them was measured. {details}".strip() if details else "Neither was measured."
    return all(count > 0 for _, count in found.values()), f"It inverts on {details}."


@claim("4.4.1", "On plane Laplacian smoothing lowers the mean quality.")
def laplacian_lowers_mean(results: Sequence[ExperimentResult]) -> Finding:
    """4.4.1, Table 4.14."""
    for result, row in with_rows(of_mesh(results, "plane", "initial"), "laplacian"):
        before, after = result.initial.q_mean, row.after.q_mean
        return after < before, f"It was {before:.4f} and is {after:.4f}."
    return None, "It was not run on plane."


@claim(
    "4.2",
    "An iteration of GETMe is more expensive than one of Laplacian smoothing, but GETMe can result in a mesh of higher "
    "quality.",
)
def getme_against_laplacian(results: Sequence[ExperimentResult]) -> Finding:
    """4.2: judged by the time of an iteration wherever both ran, and by q norm wherever that is higher."""
    slower, higher, details = [], [], []
    for result, laplacian, getme in with_rows(published(results), "laplacian", "getme"):
        if laplacian.iterations and getme.iterations:
            ratio = getme.seconds_per_iteration / laplacian.seconds_per_iteration
            slower.append(ratio > 1)
            higher.append(getme.after.q_norm > laplacian.after.q_norm)
            norms = f"{getme.after.q_norm:.4f} against {laplacian.after.q_norm:.4f}"
            details.append(f"{title(result)}: {ratio:.2g} times the time, q norm {norms}")
    if not details:
        return None, "They were not both run on a mesh."
    return all(slower) and any(higher), f"Higher in {sum(higher)} of {len(higher)} experiments. {'. '.join(details)}."


@claim("4.2", "GETMe is cheaper to perform than the optimisation methods, on most meshes.")
def getme_cheaper(results: Sequence[ExperimentResult]) -> Finding:
    """4.2: GETMe's whole time against that of the optimisers that arrive from the same mesh, on most meshes."""
    cases = {}
    for result, getme in with_rows(published(results), "getme"):
        key = name, hexes = result.experiment.mesh, result.initial.hexes
        for other in of_mesh(results, name, "initial"):
            if other.initial.hexes == hexes and (found := optimal_runs(other)):
                details = f"{name}, {hexes:,} hexes: {seconds_of([getme, found[0]])}"
                cases[key] = getme.seconds < found[0].seconds, details
    unknown = "GETMe and an optimiser that converges were not both run on a mesh."
    return tally(list(cases.values()), unknown, most=True)


@claim(
    "abstract",
    "GETMe typically raises the least and the mean quality in a time at least an order of magnitude below that of the "
    "optimisers, and ends below their quality and above that of Laplacian smoothing.",
)
def getme_typically(results: Sequence[ExperimentResult]) -> Finding:
    """Abstract: each part on every mesh where all of them ran; in most.

    Above Laplacian smoothing is judged by q min, by which it holds in all of the thesis's own tables and by q norm in
    three of seven; below the optimum by q norm, which that maximises.
    """
    found: dict[tuple[str, int], tuple[bool, bool, bool, str]] = {}
    for result, laplacian, getme in with_rows(published(results), "laplacian", "getme"):
        key = name, hexes = result.experiment.mesh, result.initial.hexes
        tops = (optimal_runs(other) for other in of_mesh(results, name, "initial") if other.initial.hexes == hexes)
        if (top := next((runs[0] for runs in tops if runs), None)) is not None:
            least = laplacian.after.q_min, getme.after.q_min
            norms = getme.after.q_norm, top.after.q_norm
            raises = getme.after.q_min > result.initial.q_min and getme.after.q_mean > result.initial.q_mean
            times = top.seconds / getme.seconds
            details = "{}, {:,} hexes: {:.1f} times, q min {:.4f} and {:.4f}, q norm {:.4f} and {:.4f}".format(
                name, hexes, times, *least, *norms
            )
            found[key] = raises, times >= _ORDER, least[0] < least[1] and norms[0] < norms[1], details
    if not found:
        return None, "Laplacian smoothing, GETMe and an optimiser that converges were not all run on a mesh."
    *counts, lines = zip(*found.values(), strict=True)
    higher, fast, between = map(sum, counts)
    figures = (
        f"Of {len(found)} meshes GETMe raises both on {higher}, is {_ORDER:g} times faster on {fast} and ends between "
        f"the two on {between}. Seconds of the fastest optimiser over those of GETMe, q min of laplacian and getme (by "
        f"which it is above), q norm of getme and that optimiser (by which it is below): {'. '.join(lines)}."
    )
    return min(higher, fast, between) > len(found) / 2, figures


@claim("3.1.2", "Sequential GETMe raises the least quality of every mesh.")
def sequential_raises_minimum(results: Sequence[ExperimentResult]) -> Finding:
    """3.1.2: confirmed there of meshes without figures, judged here from each start that it was given."""
    cases = []
    for result, row in with_rows(published(results), "getme-sequential"):
        before, after = result.start.q_min, row.after.q_min
        cases.append((after > before, f"{title(result)}: {before:.4f} to {after:.4f}"))
    return tally(cases, "It was not run.")
