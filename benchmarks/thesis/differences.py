"""Largest differences from the figures of the thesis, for meshes of equal size."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from statistics import median
from typing import Any

from hexmend.report.tables import Table

#: Figures that are compared, with their labels.
_QUALITIES = {"q_min": "q min", "q_mean": "q mean", "q_norm": "q norm"}


#: Numbers of free nodes are taken as equal within this share: plane has 17 more of 30,389.
_SAME_SHARE = 0.01


def same_counts(experiment: Mapping[str, Any]) -> bool:
    """Return True if our mesh has as many hexes as that of the thesis, and as many free nodes within 1 %."""
    (hexes, free), (own_hexes, own_free) = (
        (one["hexes"], one["free_nodes"]) for one in (experiment["thesis"], experiment)
    )
    return own_hexes == hexes and abs(own_free - free) <= _SAME_SHARE * free


def differences_table(experiments: Sequence[Mapping[str, Any]]) -> Table | None:
    """Make the table with a row for each table of the thesis: median and largest difference of each figure.

    Differences are ours minus those of the thesis; the last column is the median ratio of the iterations. None if no
    mesh has the size of that in the thesis.
    """
    rows = []
    for one in filter(same_counts, experiments):
        cells = [f"{one['table']}, {one['thesis_mesh']}"]
        found = [list(_differences(one, key)) for key in _QUALITIES]
        if not any(found):
            continue
        cells.append(str(sum(map(len, found))))
        cells += [_describe(differences) for differences in found]
        ratios = [ours / thesis for _, ours, thesis in _cells(one, "iterations")]
        cells.append(f"{median(ratios):.2g}" if ratios else "–")
        rows.append(cells)
    if not rows:
        return None
    head = ["table", "cells", *(f"{name}: median, largest" for name in _QUALITIES.values()), "iterations, times"]
    return Table("Ours minus the thesis's, where both meshes have as many hexes and free nodes", head, rows, ())


def _cells(experiment: Mapping[str, Any], key: str) -> Iterator[tuple[str, float, float]]:
    """Yield name, our value and that of the thesis for each column that has both."""
    for name, published in experiment["published"].items():
        ours = experiment["columns"].get(name, {}).get(key)
        if ours is not None and published.get(key) is not None:
            yield name, ours, published[key]


def _differences(experiment: Mapping[str, Any], key: str) -> Iterator[tuple[float, str]]:
    for name, ours, thesis in _cells(experiment, key):
        yield ours - thesis, name


def _describe(differences: list[tuple[float, str]]) -> str:
    if not differences:
        return "–"
    largest, name = max(differences, key=lambda one: abs(one[0]))
    return f"{median(value for value, _ in differences):+.4f}, {largest:+.4f} ({name})"
