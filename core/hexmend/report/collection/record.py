"""Rows of a collection by mesh and program, and figures of the meshes as given."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from hexmend.report.batch import mesh_names

#: Figures of a mesh as given, in the rows of all programs, with the key that a result has.
_GIVEN = ("inverted", "locked_inverted", "invalid", "q_min", "q_mean", "scaled_jacobian_min", "objective_p1")

#: Distance of a boundary, in per cent of the diagonal, up to which it counts as fixed.
FIXED = 1e-4


@dataclass(frozen=True)
class Program:
    """Program of a collection.

    Parameters
    ----------
    title : str
        Name of its column and of its rows.
    note : str
        Method and settings.
    version : str
        Version; "" if there is none.
    own : bool
        A run of Hexmend.
    slides : bool
        It moves nodes of the boundary.
    shape : bool
        Its objective is that of `mend` with p = 1, or nearly so.
    missing : str
        Reason why it was not run; "" if it was.
    """

    title: str
    note: str
    version: str = ""
    own: bool = False
    slides: bool = False
    shape: bool = False
    missing: str = ""


@dataclass(frozen=True)
class CollectionRecord:
    """Results of programs on a collection.

    Parameters
    ----------
    rows : sequence of mapping
        Rows of the study (`hexmend.study.batch.runner.StudyResult`).
    programs : sequence of Program
        In the order of columns; those of Hexmend first.
    tasks : int
        Number of rows when all are done.
    machine : mapping
        The computer, from `hexmend.study.bench.sections.machine`.
    limit : float
        Time limit of a program for a mesh in seconds.
    pictures : mapping
        PNG of a mesh by its path.
    """

    rows: Sequence[Mapping[str, Any]]
    programs: Sequence[Program]
    tasks: int
    machine: Mapping[str, Any]
    limit: float
    pictures: Mapping[str, bytes] = field(default_factory=dict)

    @property
    def run(self) -> list[Program]:
        """Programs that were run."""
        return [program for program in self.programs if not program.missing]

    @cached_property
    def names(self) -> dict[str, str]:
        """Name of each mesh by its path, in order."""
        return mesh_names(self.rows)

    @cached_property
    def _by_place(self) -> dict[tuple[str, str], Mapping[str, Any]]:
        return {(row["mesh"], row["case"]): row for row in self.rows}

    def row(self, mesh: str, program: Program) -> Mapping[str, Any] | None:
        """Return the row of a program on a mesh; None if it is not done yet."""
        return self._by_place.get((mesh, program.title))

    def result(self, mesh: str, program: Program) -> Mapping[str, Any] | None:
        """Return the row of a program that has a result for a mesh; else None."""
        row = self.row(mesh, program)
        return row if row is not None and row["status"] == "done" else None

    def given(self, mesh: str) -> dict[str, Any]:
        """Return the figures of a mesh as given, with the keys of a result; empty if no program could read it."""
        rows = (row for row in self.rows if row["mesh"] == mesh and row["hexes"] is not None)
        row = next(rows, None)
        if row is None:
            return {}
        return {"hexes": row["hexes"]} | {f"{key}_after": row[f"{key}_before"] for key in _GIVEN}

    def reason(self, mesh: str) -> str:
        """Return the reason if a mesh has no result of any program, else ""."""
        rows = [row for row in self.rows if row["mesh"] == mesh]
        return rows[0]["reason"] if all(row["status"] != "done" for row in rows) else ""
