"""Remarks on results of Hexmend that are worse than the mesh as given or than the result of another program."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from hexmend.quantity import format_count, format_objective, format_quality
from hexmend.report.collection.record import FIXED, CollectionRecord, Program

#: Figures that are compared: key, label, whether higher is better, and format.
_COMPARED = (
    ("inverted_after", "inverted", False, format_count),
    ("invalid_after", "invalid", False, format_count),
    ("scaled_jacobian_min_after", "scaled Jacobian min", True, format_quality),
    ("q_min_after", "q min", True, format_quality),
    ("q_mean_after", "q mean", True, format_quality),
)

#: The same for the objective of programs that minimise it.
_OBJECTIVE = ("objective_p1_after", "Σ η", False, format_objective)

#: Smallest difference that counts: half a unit of the last digit that is shown.
_DIFFERENCE = 5e-5

#: Smallest relative difference of two objectives that counts.
_OBJECTIVE_DIFFERENCE = 1e-6


def remark(record: CollectionRecord, mesh: str, program: Program) -> str:
    """Describe the figures in which a result of Hexmend is worse.

    It is compared with the mesh as given, and with results of other programs that leave no more invalid hexes and, for
    a fixed boundary, leave the boundary where it was.

    Parameters
    ----------
    record : CollectionRecord
    mesh : str
        Path of the mesh.
    program : Program

    Returns
    -------
    str
        Such as "lower q mean: hexsmoothing 0.8963, as given 0.8945"; "" if there is nothing to say.
    """
    ours = record.result(mesh, program)
    if ours is None or not program.own:
        return ""
    others = list(_comparable(record, mesh, program, ours))
    words = []
    for key, label, higher, text in (*_COMPARED, *([_OBJECTIVE] if program.shape else [])):
        better = [
            f"{title} {text(values[key])}"
            for title, values, shape in others
            if (key != _OBJECTIVE[0] or shape) and _is_better(values[key], ours[key], higher, key)
        ]
        if better:
            words.append(f"{'lower' if higher else 'higher'} {label}: {', '.join(better)}")
    return "; ".join(words)


def _comparable(
    record: CollectionRecord, mesh: str, program: Program, ours: Mapping[str, Any]
) -> Iterator[tuple[str, Mapping[str, Any], bool]]:
    """Yield title, figures, and whether the objective is common, of the mesh as given and of other programs."""
    yield "as given", record.given(mesh), False
    for other in record.run:
        row = record.result(mesh, other)
        if other.own or row is None or row["invalid_after"] > ours["invalid_after"]:
            continue
        if program.slides or row["boundary_distance"] <= FIXED:
            yield other.title, row, other.shape


def _is_better(other: float | None, ours: float | None, higher: bool, key: str) -> bool:
    if other is None or ours is None:
        return False
    difference = other - ours if higher else ours - other
    return difference > (_OBJECTIVE_DIFFERENCE * abs(ours) if key == _OBJECTIVE[0] else _DIFFERENCE)
