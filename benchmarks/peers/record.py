"""Results of programs on meshes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from benchmarks.peers.peer import Peer
from hexmend.report.documents import mesh_names

#: Figures of a mesh as given, in the rows of all programs, with the key that a result has.
_GIVEN = ("inverted", "locked_inverted", "invalid", "q_min", "q_mean", "scaled_jacobian_min", "objective_p1")


@dataclass(frozen=True)
class Comparison:
    """Results of programs on meshes.

    Parameters
    ----------
    rows : sequence of mapping
        One for each mesh and program, see `benchmarks.peers.compare.compare`.
    programs : sequence of Peer
        In the order of columns; those of Hexmend first.
    versions : mapping
        Version by the name of a program that is installed.
    missing : mapping
        Reason why a program was not run, by its name.
    machine : mapping
        The computer, from `hexmend.study.machine.machine`.
    limit : float
        Time limit of a program for a mesh in seconds.
    """

    rows: Sequence[Mapping[str, Any]]
    programs: Sequence[Peer]
    versions: Mapping[str, str]
    missing: Mapping[str, str]
    machine: Mapping[str, Any]
    limit: float

    @property
    def run(self) -> list[Peer]:
        """Programs that were run."""
        return [program for program in self.programs if program.name not in self.missing]

    @cached_property
    def names(self) -> dict[str, str]:
        """Name of each mesh by its path, in order."""
        return mesh_names(self.rows)

    @cached_property
    def _by_place(self) -> dict[tuple[str, str], Mapping[str, Any]]:
        return {(row["mesh"], row["program"]): row for row in self.rows}

    def row(self, mesh: str, program: Peer) -> Mapping[str, Any]:
        """Return the row of a program on a mesh."""
        return self._by_place[mesh, program.name]

    def result(self, mesh: str, program: Peer) -> Mapping[str, Any] | None:
        """Return the row of a program that has a result for a mesh; else None."""
        row = self.row(mesh, program)
        return row if row["status"] == "done" else None

    def given(self, mesh: str) -> dict[str, Any]:
        """Return the figures of a mesh as given, with the keys of a result; empty if it could not be read."""
        row = self.row(mesh, self.programs[0])
        if "hexes" not in row:
            return {}
        return {"hexes": row["hexes"]} | {f"{key}_after": row[f"{key}_before"] for key in _GIVEN}

    def reason(self, mesh: str) -> str:
        """Return the reason if a mesh has no result of any program, else ""."""
        rows = [row for row in self.rows if row["mesh"] == mesh]
        return rows[0]["reason"] if all(row["status"] != "done" for row in rows) else ""
