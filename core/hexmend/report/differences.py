"""Where our figures are furthest from the thesis's, on meshes of the same counts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from statistics import median
from typing import Any

from hexmend.report.tables import Table

#: Qualities that are compared, and what they are called.
_QUALITIES = {"q_min": "q min", "q_mean": "q mean", "q_norm": "q norm"}


def same_counts(experiment: Mapping[str, Any]) -> bool:
    """Whether our mesh has as many hexes and free nodes as the thesis's."""
    thesis = experiment["thesis"]
    return (experiment["hexes"], experiment["free_nodes"]) == (thesis["hexes"], thesis["free_nodes"])


def differences_table(experiments: Sequence[Mapping[str, Any]]) -> Table | None:
    """One row a table of the thesis: the median and the largest difference of each quality, with the method's name.

    Differences are ours minus the thesis's; the last column is the median of our iterations over the thesis's. None
    where no mesh has the thesis's counts.
    """
    rows = []
    for one in filter(same_counts, experiments):
        cells = [f"{one['table']}, {one['thesis_mesh']}"]
        found = [list(_apart(one, key)) for key in _QUALITIES]
        if not any(found):
            continue
        cells.append(str(sum(map(len, found))))
        cells += [_told(differences) for differences in found]
        ratios = [ours / thesis for _, ours, thesis in _cells(one, "iterations")]
        cells.append(f"{median(ratios):.2g}" if ratios else "–")
        rows.append(cells)
    if not rows:
        return None
    head = ["table", "cells", *(f"{name}: median, largest" for name in _QUALITIES.values()), "iterations, times"]
    return Table("Ours minus the thesis's, where both meshes have as many hexes and free nodes", head, rows, ())


def _cells(experiment: Mapping[str, Any], key: str) -> Iterator[tuple[str, float, float]]:
    """Each column that has this figure with us and in the thesis."""
    for name, published in experiment["published"].items():
        ours = experiment["columns"].get(name, {}).get(key)
        if ours is not None and published.get(key) is not None:
            yield name, ours, published[key]


def _apart(experiment: Mapping[str, Any], key: str) -> Iterator[tuple[float, str]]:
    for name, ours, thesis in _cells(experiment, key):
        yield ours - thesis, name


def _told(differences: list[tuple[float, str]]) -> str:
    if not differences:
        return "–"
    largest, name = max(differences, key=lambda one: abs(one[0]))
    return f"{median(value for value, _ in differences):+.4f}, {largest:+.4f} ({name})"
