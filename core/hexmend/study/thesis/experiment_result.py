"""What one experiment of a study gave."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from hexmend.mesh.mesh import Mesh
from hexmend.quality import Summary
from hexmend.study.table_row import Row, common_power, initial_record
from hexmend.study.thesis.experiments import INITIAL, Experiment


@dataclass(frozen=True, eq=False)
class ExperimentResult:
    """An experiment with our figures.

    Parameters
    ----------
    experiment : Experiment
    mesh : Mesh
        As the gallery made it.
    initial : Summary
        Of that mesh.
    rows : mapping of str to Row
        By column; where the start is a method's, its row is the first.
    """

    experiment: Experiment
    mesh: Mesh
    initial: Summary
    rows: Mapping[str, Row]

    @property
    def start(self) -> Summary:
        """What the methods began from."""
        first = self.rows.get(self.experiment.start)
        return first.after if first is not None and first.after is not None else self.initial

    def record(self) -> dict[str, Any]:
        """The experiment for other programs, ours under "columns" and the thesis's under "published"."""
        one, power = self.experiment, common_power(self.rows.values())
        columns = {name: row.record(power) for name, row in self.rows.items()}
        if one.start == INITIAL:
            columns = {INITIAL: initial_record(self.mesh, self.initial, power)} | columns
        return {
            "table": one.table,
            "thesis_mesh": one.thesis_mesh,
            "mesh": one.mesh,
            "start": one.start,
            "delta": one.delta,
            "hexes": self.initial.hexes,
            "free_nodes": self.initial.free_nodes,
            "inverted": self.start.inverted,
            "thesis": {"hexes": one.hexes, "free_nodes": one.free_nodes, "inverted": one.inverted},
            "columns": columns,
            "published": {name: dict(figures) for name, figures in one.published.items()},
        }
