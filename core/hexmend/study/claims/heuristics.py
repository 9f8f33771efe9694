"""Claims of Laplacian smoothing and GETMe."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from hexmend.quality import measure
from hexmend.study.claims.claim import Finding, judges, tally
from hexmend.study.claims.reading import arrivals, ended, name, of_mesh, settled, tables, times
from hexmend.study.thesis.experiment_result import ExperimentResult

#: "An order of magnitude".
_ORDER = 10.0


@judges("4.2, 4.4.1", "Laplacian smoothing inverts hexes on bridge-sharp and on plane.")
def laplacian_inverts(measured: Sequence[ExperimentResult]) -> Finding:
    """4.2, 4.4.1: judged by the hexes that were sound before, on the largest of the meshes."""
    found: dict[str, tuple[int, int]] = {}
    for one in itertools.chain(of_mesh(measured, "bridge-sharp"), of_mesh(measured, "plane")):
        if one.initial.hexes > found.get(one.experiment.mesh, (0, 0))[0] and (rows := ended(one, "laplacian")):
            before, after = (measure(mesh.points, mesh.hexes).inverted for mesh in (one.mesh, rows[0].mesh))
            found[one.experiment.mesh] = one.initial.hexes, int(np.count_nonzero(after & ~before))
    told = "; ".join(f"{mesh}, {hexes:,} hexes: {count:,} of the sound" for mesh, (hexes, count) in found.items())
    if len(found) < 2:
        return None, f"Only one of them was measured. {told}".strip() if told else "Neither was measured."
    return all(count > 0 for _, count in found.values()), f"It inverts on {told}."


@judges("4.4.1", "On plane Laplacian smoothing lowers the mean quality.")
def laplacian_lowers_mean(measured: Sequence[ExperimentResult]) -> Finding:
    """4.4.1, Table 4.14."""
    for one in of_mesh(measured, "plane", "initial"):
        if rows := ended(one, "laplacian"):
            before, after = one.initial.q_mean, rows[0].after.q_mean
            return after < before, f"It was {before:.4f} and is {after:.4f}."
    return None, "It was not run on plane."


@judges("4.4.1", "On plane GETMe raises the least and the mean quality, but not as much as optimisation.")
def getme_between(measured: Sequence[ExperimentResult]) -> Finding:
    """4.4.1, Table 4.14."""
    for one in of_mesh(measured, "plane", "initial"):
        if (rows := ended(one, "getme")) and (found := settled(one)):
            top = found[0]
            three = one.initial, rows[0].after, top.after
            least, mean = [it.q_min for it in three], [it.q_mean for it in three]
            told = (
                f"q min is {least[0]:.4f} at the start, {least[1]:.4f} by getme, {least[2]:.4f} by {top.method} "
                f"({top.after.inverted:,} inverted); q mean is {mean[0]:.4f}, {mean[1]:.4f}, {mean[2]:.4f}."
            )
            return least[0] < least[1] < least[2] and mean[0] < mean[1] < mean[2], told
    return None, "GETMe and an optimiser that converges were not both run on plane."


@judges(
    "4.4.1",
    "On plane the heuristics converge much more rapidly: the fastest optimiser, local steepest descent, is more than "
    "an order of magnitude slower than the slower of them, GETMe.",
)
def heuristics_faster(measured: Sequence[ExperimentResult]) -> Finding:
    """4.4.1, Table 4.15."""
    for one in of_mesh(measured, "plane", "initial"):
        if (rows := ended(one, "laplacian", "getme")) and (found := arrivals(one)):
            slowest, fastest = max(row.seconds for row in rows), found[0]
            told = (
                f"{times([*rows, *found])}: the fastest optimiser takes {fastest.seconds / slowest:.2g} times as long."
            )
            return fastest.method == "local-sd" and fastest.seconds > _ORDER * slowest, told
    return None, "The heuristics and an optimiser that converges were not all run on plane."


@judges(
    "4.2",
    "An iteration of GETMe is more expensive than one of Laplacian smoothing, but GETMe can result in a mesh of higher "
    "quality.",
)
def getme_against_laplacian(measured: Sequence[ExperimentResult]) -> Finding:
    """4.2: judged by the time of an iteration wherever both ran, and by q norm wherever that is higher."""
    dearer, higher, told = [], [], []
    for one in tables(measured):
        if rows := ended(one, "laplacian", "getme"):
            laplacian, getme = rows
            if laplacian.iterations and getme.iterations:
                ratio = getme.seconds_per_iteration / laplacian.seconds_per_iteration
                dearer.append(ratio > 1)
                higher.append(getme.after.q_norm > laplacian.after.q_norm)
                told.append(
                    f"{name(one)}: {ratio:.2g} times the time, q norm {getme.after.q_norm:.4f} against "
                    f"{laplacian.after.q_norm:.4f}"
                )
    if not told:
        return None, "They were not both run on a mesh."
    return all(dearer) and any(higher), f"Higher in {sum(higher)} of {len(higher)} experiments. {'. '.join(told)}."


@judges("4.2", "GETMe is cheaper to perform than the optimisation methods.")
def getme_cheaper(measured: Sequence[ExperimentResult]) -> Finding:
    """4.2: GETMe's whole time against that of the optimisers that arrive from the same mesh."""
    cases = {}
    for one in tables(measured):
        for other in of_mesh(measured, one.experiment.mesh, "initial"):
            same = other.initial.hexes == one.initial.hexes
            if same and (rows := ended(one, "getme")) and (found := arrivals(other)):
                key = one.experiment.mesh, one.initial.hexes
                told = f"{key[0]}, {key[1]:,} hexes: {times([*rows, found[0]])}"
                cases[key] = rows[0].seconds < found[0].seconds, told
    return tally(list(cases.values()), "GETMe and an optimiser that converges were not both run on a mesh.")


@judges("3.1.2", "Sequential GETMe raises the least quality of every mesh.")
def sequential_raises_minimum(measured: Sequence[ExperimentResult]) -> Finding:
    """3.1.2: confirmed there of meshes without figures, judged here from each start that it was given."""
    cases = []
    for one in tables(measured):
        for row in ended(one, "getme-sequential"):
            before, after = one.start.q_min, row.after.q_min
            cases.append((after > before, f"{name(one)}: {before:.4f} to {after:.4f}"))
    return tally(cases, "It was not run.")
